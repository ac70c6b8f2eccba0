// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "region_map.h"
#include "wall_line.h"

namespace mrpt_sgraphs {

/// The surroundings of a region, cut into faces by the lines that may bound it: those of its walls,
/// and where no wall was found, lines along the edge of the free space.
struct RoomPlan {
  std::vector<Line2> lines;
  std::vector<std::vector<std::size_t>> barriers;  ///< On each line; none: edge of free space.
  LineArrangement arrangement;
};

RoomPlan planOf(const RegionMap& map, int region, const std::vector<WallLine>& barriers);

/// The part of a border that lies on barriers which look to one side of it.
double boundedLength(const LineArrangement::Border& border, bool in_front, const RoomPlan& plan,
                     const std::vector<WallLine>& barriers);

}  // namespace mrpt_sgraphs
