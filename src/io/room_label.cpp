// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "room_label.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/semantics/places.h"

namespace mrpt_sgraphs {
namespace {

/// How far a place in the room is from its border; negative outside.
double depthOf(const RoomNode& room, const Eigen::Vector2d& place_map) {
  const Eigen::Vector3d place(place_map.x(), place_map.y(), 0.0);
  const double distance_m = nearestBorder(room, place)->distance_m;
  return isAround(room, place) ? distance_m : -distance_m;
}

Eigen::Vector2d labelPlace(const RoomNode& room) {
  constexpr int kSteps = 24;
  constexpr double kDeepEnough_m = 0.6;
  const Eigen::Vector2d centre = room.T_map_room.translation().head<2>();
  if (depthOf(room, centre) >= kDeepEnough_m) return centre;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : room.extent_map.outline) {
    box.extend(corner.head<2>().eval());
  }
  Eigen::Vector2d best = centre;
  double depth_m = depthOf(room, centre);
  for (int i = 1; i < kSteps; ++i) {
    for (int k = 1; k < kSteps; ++k) {
      const Eigen::Vector2d share(static_cast<double>(i) / kSteps, static_cast<double>(k) / kSteps);
      const Eigen::Vector2d place = box.min() + share.cwiseProduct(box.sizes());
      const double here_m = depthOf(room, place);
      if (here_m <= depth_m) continue;
      depth_m = here_m;
      best = place;
    }
  }
  return best;
}

}  // namespace

RoomLabel labelOf(const RoomNode& room) {
  constexpr double kLong = 2.0;       // sides: along such a room its name is written
  constexpr double kLetter = 0.6;     // width of a letter over its height
  constexpr double kFilled = 0.85;    // of the room
  constexpr double kLeast_m = 0.16;
  constexpr double kMost_m = 0.5;
  const Eigen::Vector3d x_map = room.T_map_room.linear().col(0);
  double turn_rad = std::atan2(x_map.y(), x_map.x());
  const bool is_long = room.size_m.maxCoeff() > kLong * room.size_m.minCoeff();
  const bool along_y = is_long ? room.size_m.y() > room.size_m.x()
                               : std::abs(std::cos(turn_rad)) < std::abs(std::sin(turn_rad));
  if (along_y) turn_rad += M_PI_2;
  turn_rad = std::remainder(turn_rad, M_PI);  // not upside down

  const double space_m = along_y ? room.size_m.y() : room.size_m.x();
  const double letters = static_cast<double>(std::max<std::size_t>(room.name.size(), 6));
  RoomLabel label;
  label.place_map = labelPlace(room);
  label.turn_rad = turn_rad;
  label.text_m = std::clamp(kFilled * space_m / (kLetter * letters), kLeast_m, kMost_m);
  return label;
}

}  // namespace mrpt_sgraphs
