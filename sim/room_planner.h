// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "sim/floor_plan.h"

namespace mrpt_sgraphs::sim {

/// Ways inside one room that keep clear of walls and furniture (A* on a grid, then pulled taut).
class RoomPlanner {
 public:
  RoomPlanner(const FloorPlan& plan, const Polygon2& outline);

  /// Corners of a way, without `from` and with `to`; nothing if there is none.
  std::optional<Polygon2> path(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// The free place of the room nearest to the point; nothing if the room is full.
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& point) const;

  /// Where the room is widest.
  Eigen::Vector2d middle() const;

  /// Places to see the room from, around it counter-clockwise: near its corners, or at the ends of
  /// a corridor.
  Polygon2 round(RoomKind kind) const;

 private:
  size_t cellOf(const Eigen::Vector2d& point) const;
  Eigen::Vector2d centreOf(size_t cell) const;
  bool isFree(size_t cell) const;
  bool sees(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  std::vector<size_t> search(size_t start, size_t goal) const;
  Polygon2 taut(const Polygon2& points) const;

  Polygon2 outline_;
  Eigen::Vector2d origin_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<double> clearance_m_;  ///< Row by row; negative outside the room.
};

}  // namespace mrpt_sgraphs::sim
