// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/GraphKeyframe.h"
#include "mrpt_sgraphs/Polygon3.h"
#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"

namespace mrpt_sgraphs {

inline std::vector<geometry_msgs::Point> toPoints(const Outline3& outline) {
  std::vector<geometry_msgs::Point> points;
  points.reserve(outline.size());
  for (const Eigen::Vector3d& corner : outline) points.push_back(tf2::toMsg(corner));
  return points;
}

inline Outline3 toOutline(const std::vector<geometry_msgs::Point>& points) {
  Outline3 outline;
  outline.reserve(points.size());
  for (const geometry_msgs::Point& point : points) outline.emplace_back(point.x, point.y, point.z);
  return outline;
}

template <typename Layer>
std::int64_t toIdMsg(const std::optional<Id<Layer>>& id) {
  return id ? static_cast<std::int64_t>(id->value) : std::int64_t{GraphKeyframe::NONE};
}

template <typename Layer>
std::vector<std::uint64_t> toIdsMsg(const std::vector<Id<Layer>>& ids) {
  std::vector<std::uint64_t> msg;
  msg.reserve(ids.size());
  for (const Id<Layer> id : ids) msg.push_back(id.value);
  return msg;
}

/// What the messages of all that has an extent have in common: `polygon` and `holes`.
template <typename Message>
void setExtent(const PlanarExtent& extent, Message* msg) {
  msg->polygon = toPoints(extent.outline);
  for (const Outline3& hole : extent.holes) {
    msg->holes.emplace_back();
    msg->holes.back().points = toPoints(hole);
  }
}

/// What the messages of all surfaces have in common: those, `normal` and `distance`.
template <typename Message>
void setSurface(const Plane& plane, const PlanarExtent& extent, Message* msg) {
  tf2::toMsg(plane.normal, msg->normal);
  msg->distance = plane.distance;
  setExtent(extent, msg);
}

template <typename Message>
Plane planeOf(const Message& msg) {
  return {{msg.normal.x, msg.normal.y, msg.normal.z}, msg.distance};
}

template <typename Message>
PlanarExtent extentOf(const Message& msg) {
  PlanarExtent extent{toOutline(msg.polygon), {}};
  for (const Polygon3& hole : msg.holes) extent.holes.push_back(toOutline(hole.points));
  return extent;
}

}  // namespace mrpt_sgraphs
