// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "sim/building.h"

namespace mrpt_sgraphs::sim {

/// Where a robot can stand on one storey. Furniture counts with its whole footprint, and so do
/// stairs and the opening above them.
class FloorPlan {
 public:
  FloorPlan(const Building& building, size_t storey);

  /// How far the nearest wall, piece of furniture or pillar is [m]; negative inside them and in
  /// the solid between rooms.
  double clearance(const Eigen::Vector2d& point_map) const;

 private:
  struct Round {
    Eigen::Vector2d centre;
    double radius_m;
  };

  bool isOpen(const Eigen::Vector2d& point_map) const;

  std::vector<Polygon2> open_;                                      ///< Rooms and door passages.
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls_;  ///< With gaps at the doors.
  std::vector<Polygon2> footprints_;
  std::vector<Round> rounds_;
};

}  // namespace mrpt_sgraphs::sim
