// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/line_arrangement.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A wall as it is drawn in the plan of a storey: a line, and how far the wall goes along it, doors
/// and windows included. The normal points into the room. Frame: `floor`.
struct WallLine {
  WallId id;
  Line2 line;
  double begin_m = 0.0;  ///< Along the line.
  double end_m = 0.0;
  double top_m = 0.0;  ///< Above the ground: where it was seen highest.
  FlatExtent extent;   ///< Along the line and above the ground.

  Eigen::Vector2d at(double along_m) const {
    return line.distance * line.normal + along_m * line.along();
  }

  /// From where to where it goes along a line that is nearly its own.
  std::pair<double, double> spanOn(const Line2& other) const {
    return std::minmax<double>({other.along().dot(at(begin_m)), other.along().dot(at(end_m))});
  }

  /// Whether it looks to the front of a line that is nearly its own.
  bool looksAlong(const Line2& other) const { return other.normal.dot(line.normal) > 0.0; }
};

/// Part of the plan at a certain height, of which walls it may be said that they stand in it.
struct Slab {
  double bottom_m = 0.0;  ///< Above the ground.
  double top_m = 0.0;
};

/// The walls of a storey: those that are told to be on it, and of the others those in the slab.
/// @param T_floor_map  z is up, and zero on the ground.
std::vector<WallLine> wallLinesOf(const SharedVector<WallNode>& walls,
                                  const std::optional<FloorId>& floor, const Pose& T_floor_map,
                                  const Slab& slab);

/// Where no way leads through: every wall from its first to its last piece, and on to the next wall
/// where the passage that is left is no wider than a door.
/// @param max_door_m     Between the end of a wall and another one across its way,
/// @param max_passage_m  and between two walls in one line.
std::vector<WallLine> barriersOf(const std::vector<WallLine>& walls, double max_door_m,
                                 double max_passage_m);

}  // namespace mrpt_sgraphs
