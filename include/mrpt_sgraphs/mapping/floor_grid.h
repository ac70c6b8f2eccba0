// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_grid.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/occupancy_map.h"

namespace mrpt_sgraphs {

/// What a robot on a floor can drive over, in the values of nav_msgs/OccupancyGrid.
struct FloorGrid {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  FloorId floor;
  double cell_m = 0.1;
  double ground_m = 0.0;       ///< Height of the ground in `map`, in the middle of the grid.
  CellGrid<std::int8_t> cells;  ///< Along x and y of `map`, around all that is known.

  friend bool operator==(const FloorGrid& a, const FloorGrid& b);
};

/// A grid of every floor: the band of heights above its ground, which may be tilted, seen from
/// above. A cell is occupied where a voxel of its column is, else free where one is. Where floors
/// lie beside each other a place is of the one that the robot was on nearest by, and unknown in the
/// grids of the others. Floors of which nothing is known have none.
std::vector<FloorGrid> floorGrids(const OccupancyMap& map, const GraphSnapshot& graph,
                                  const MapConfig& config);

}  // namespace mrpt_sgraphs
