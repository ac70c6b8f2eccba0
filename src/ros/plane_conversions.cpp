// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
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
    // what the graph would refuse, and the keyframe with it
    if (isSound(plane)) planes->push_back(std::move(plane));
  }
  return planes;
}

}  // namespace mrpt_sgraphs
