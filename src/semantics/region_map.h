// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_grid.h"
#include "mrpt_sgraphs/mapping/free_space.h"
#include "wall_line.h"

namespace mrpt_sgraphs {

/// The free space of a storey, cut along its barriers into regions.
struct RegionMap {
  static constexpr int kNone = -1;

  /// A stretch of a barrier that one can walk through, from one region to another. A door in a
  /// thick wall is in the barriers of both faces.
  struct Opening {
    int front = kNone;  ///< Region on the side that the barrier's normal points to,
    int back = kNone;   ///< and behind it.
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double width_m = 0.0;
  };

  double cell_m = 0.1;
  CellGrid<int> region;            ///< Of each cell; kNone: not free, or on a barrier.
  std::vector<std::size_t> sizes;  ///< Of each region, in cells; 0: joined with a lower one.
  std::vector<CellBox> boxes;      ///< Around each region.
  std::vector<Opening> openings;   ///< Between regions.

  int regionAt(const Eigen::Vector2d& point) const {
    return region.valueOr(cellAt(point, cell_m), kNone);
  }
};

/// Regions are one where a barrier parts them over more than `max_passage_m` of open space (there
/// is no wall then), or runs across a corridor.
RegionMap regionsOf(const FreeSpace& space, const std::vector<WallLine>& barriers,
                    double max_passage_m);

}  // namespace mrpt_sgraphs
