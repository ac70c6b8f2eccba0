// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <tf2_eigen/tf2_eigen.h>

#include <vector>

#include "mrpt_sgraphs/Polygon3.h"
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

/// What the messages of all surfaces have in common: `normal`, `distance`, `polygon` and `holes`.
template <typename Message>
void setSurface(const Plane& plane, const PlanarExtent& extent, Message* msg) {
  tf2::toMsg(plane.normal, msg->normal);
  msg->distance = plane.distance;
  msg->polygon = toPoints(extent.outline);
  for (const Outline3& hole : extent.holes) {
    msg->holes.emplace_back();
    msg->holes.back().points = toPoints(hole);
  }
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
