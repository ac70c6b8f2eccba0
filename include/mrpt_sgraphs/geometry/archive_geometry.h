// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/archive.h"
#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/keyframe_runs.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"

namespace mrpt_sgraphs {

template <typename Archive, typename Layer>
void part(Archive& a, Id<Layer>& id) {
  a.item(id.value);
}

template <typename Archive>
void part(Archive& a, NodeId& node) {
  a.item(node.layer);
  a.item(node.value);
}

template <typename Archive>
void part(Archive& a, KeyframeRuns::Run& run) {
  a.item(run.first);
  a.item(run.last);
}

template <typename Archive>
void part(Archive& a, KeyframeRuns& keyframes) {
  std::vector<KeyframeRuns::Run> runs = keyframes.runs();
  a.item(runs);
  if constexpr (Archive::kReads) keyframes = KeyframeRuns(std::move(runs));
}

template <typename Archive>
void part(Archive& a, Plane& plane) {
  a.item(plane.normal);
  a.item(plane.distance);
}

template <typename Archive>
void part(Archive& a, PlanarExtent& extent) {
  a.item(extent.outline);
  a.item(extent.holes);
}

template <typename Archive>
void part(Archive& a, ObservedPlane& plane) {
  a("plane_base", plane.plane_base);
  a("covariance", plane.covariance);
  a("centroid_base", plane.centroid_base);
  a("extent_base", plane.extent_base);
  a("area_m2", plane.area_m2);
  a("points", plane.points);
}

template <typename Archive>
void part(Archive& a, PlaneFrame& frame) {
  a.item(frame.origin);
  a.item(frame.normal);
  a.item(frame.u);
  a.item(frame.v);
}

template <typename Archive>
void part(Archive& a, Cell& cell) {
  a.item(cell.column);
  a.item(cell.row);
}

template <typename Archive>
void part(Archive& a, CellBox& box) {
  a.item(box.min);
  a.item(box.max);
}

template <typename Archive>
void part(Archive& a, Point& point) {
  a.raw(point.data, 3 * sizeof(float));
  point.data[3] = 1.0F;
  a.item(point.intensity);
  a.item(point.time);
  a.item(point.ring);
}

template <typename Archive>
void part(Archive& a, Cloud& cloud) {
  a("stamp", cloud.header.stamp);
  a("seq", cloud.header.seq);
  a("frame_id", cloud.header.frame_id);
  a.raw(cloud.sensor_origin_.data(), 4 * sizeof(float));
  a.raw(cloud.sensor_orientation_.coeffs().data(), 4 * sizeof(float));
  a("width", cloud.width);
  a("height", cloud.height);
  a("is_dense", cloud.is_dense);
  const std::size_t points = a.count(cloud.size());
  if constexpr (Archive::kReads) cloud.points.resize(points);
  for (Point& point : cloud.points) a.item(point);
}

}  // namespace mrpt_sgraphs
