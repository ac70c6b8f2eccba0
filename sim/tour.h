// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/building.h"
#include "sim/floor_plan.h"

namespace mrpt_sgraphs::sim {

/// A corner of the robot's way, on the floor, in the map frame.
struct RoutePoint {
  Eigen::Vector3d floor_map = Eigen::Vector3d::Zero();
  size_t storey = 0;
  bool by_stairs = false;  ///< The leg to this point climbs or descends.
};
using Route = std::vector<RoutePoint>;

/// The way of a building's tour: from room to room through the fewest doors and flights (breadth
/// first), straight through the middle of each door, and in each room round it or along the points
/// given.
/// @param plans  One for each storey.
/// @throws std::invalid_argument naming the stop of the tour that cannot be walked to.
Route planTour(const Building& building, const std::vector<FloorPlan>& plans);

}  // namespace mrpt_sgraphs::sim
