// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/building.h"

namespace mrpt_sgraphs::sim {

/// A rectangle in a wall face: along it from its first corner, and up from the floor.
struct FaceOpening {
  double begin_m = 0.0;
  double end_m = 0.0;
  double bottom_m = 0.0;
  double top_m = 0.0;
  bool window = false;  ///< Else a door.
};

/// One side of a wall, seen from inside its room: an edge of the outline, from floor to ceiling.
/// All in the map frame.
struct WallFace {
  size_t room = 0;
  size_t storey = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
  double floor_m = 0.0;
  double height_m = 0.0;
  std::vector<FaceOpening> openings;

  double length_m() const { return (second - first).norm(); }
  Eigen::Vector2d along() const { return (second - first).normalized(); }
  Eigen::Vector2d inward() const { return leftOf(along()); }

  /// The point `s_m` along the face and `up_m` above the floor.
  Eigen::Vector3d at(double s_m, double up_m) const {
    const Eigen::Vector2d p = first + s_m * along();
    return {p.x(), p.y(), floor_m + up_m};
  }
};

/// Every wall face of the building, room by room in the order of the outlines' edges; its index is
/// the wall's id.
std::vector<WallFace> wallFaces(const Building& building);

/// Where a door pierces one of its two faces: the jambs' corners on the floor, in the direction of
/// the face.
struct DoorEdge {
  Eigen::Vector2d begin = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  Eigen::Vector2d inward = Eigen::Vector2d::Zero();  ///< Into the room of that side.

  Eigen::Vector2d middle() const { return 0.5 * (begin + end); }
};
DoorEdge doorEdge(const Building& building, const Door& door, size_t side);

}  // namespace mrpt_sgraphs::sim
