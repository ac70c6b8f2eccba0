// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>

#include "mrpt_sgraphs/ros/conversions.h"
#include "surface_message.h"

namespace mrpt_sgraphs {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

KeyframePlane toMsg(const ObservedPlane& plane) {
  KeyframePlane msg;
  setSurface(plane.plane_base, plane.extent_base, &msg);
  Eigen::Map<RowMajor3>(msg.covariance.data()) = plane.covariance;
  msg.centroid = tf2::toMsg(plane.centroid_base);
  msg.area = plane.area_m2;
  msg.points = plane.points;
  return msg;
}

ObservedPlane toObservedPlane(const KeyframePlane& msg) {
  ObservedPlane plane;
  plane.plane_base = planeOf(msg);
  plane.extent_base = extentOf(msg);
  plane.covariance = Eigen::Map<const RowMajor3>(msg.covariance.data());
  tf2::fromMsg(msg.centroid, plane.centroid_base);
  plane.area_m2 = msg.area;
  plane.points = msg.points;
  return plane;
}

bool allFinite(const Outline3& outline) {
  return std::all_of(outline.begin(), outline.end(),
                     [](const Eigen::Vector3d& corner) { return corner.allFinite(); });
}

/// What the graph would refuse, and the keyframe with it.
bool isPlane(const ObservedPlane& plane) {
  constexpr double kMaxError = 1e-6;
  const bool has_direction = std::abs(plane.plane_base.normal.norm() - 1.0) < kMaxError;
  const bool is_covariance =
      plane.covariance.allFinite() && plane.covariance.llt().info() == Eigen::Success;
  const auto& holes = plane.extent_base.holes;
  return has_direction && std::isfinite(plane.plane_base.distance) && is_covariance &&
         plane.centroid_base.allFinite() && allFinite(plane.extent_base.outline) &&
         std::all_of(holes.begin(), holes.end(), allFinite);
}

}  // namespace

KeyframePlanes toMsg(const ObservedPlanesConstPtr& planes, const std_msgs::Header& header) {
  KeyframePlanes msg;
  msg.header = header;
  msg.observed = planes != nullptr;
  if (planes == nullptr) return msg;
  for (const ObservedPlane& plane : *planes) msg.planes.push_back(toMsg(plane));
  return msg;
}

ObservedPlanesConstPtr toObservedPlanes(const KeyframePlanes& msg) {
  if (!msg.observed) return nullptr;
  const auto planes = std::make_shared<ObservedPlanes>();
  for (const KeyframePlane& line : msg.planes) {
    ObservedPlane plane = toObservedPlane(line);
    if (isPlane(plane)) planes->push_back(std::move(plane));
  }
  return planes;
}

}  // namespace mrpt_sgraphs
