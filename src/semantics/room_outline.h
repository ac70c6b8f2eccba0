// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "region_map.h"
#include "wall_line.h"

namespace mrpt_sgraphs {

/// What a region is when walls bound it.
struct RoomOutline {
  FlatExtent extent;
  std::vector<WallId> walls;  ///< On which some of the outline lies, in the order of `walls`.
  double length_m = 0.0;      ///< Of the outline,
  double bounded_m = 0.0;     ///< and the part of it that lies on walls, doors included.
};

/// The outline of a region: the lines of its walls cut the plan into faces, and each face is in the
/// room or not, so that the room holds what is free of the region and little else and its outline
/// runs along walls where it can: the least cut between the two (Mura et al., "Automatic room
/// detection and reconstruction in cluttered indoor environments with complex room layouts", 2014,
/// have the idea). Where no wall was found, lines along the edge of the free space stand in.
/// @param barriers  Of `walls`, one each.
RoomOutline roomOutlineOf(const RegionMap& map, int region, const FreeSpace& space,
                          const std::vector<WallLine>& walls,
                          const std::vector<WallLine>& barriers);

}  // namespace mrpt_sgraphs
