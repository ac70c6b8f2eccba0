// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A piece of a wall as seen from above: a rectangle in x and y of the map, whose first two corners
/// lie on a face that was seen.
struct WallFootprint {
  WallId wall;
  Outline2 corners_map;   ///< [m]
  bool measured = false;  ///< Both faces were seen, and so its thickness.
};

/// Of the walls of a floor, at the heights at which people see them: doors are open, lintels and
/// skirtings do not show.
/// @param floor   None: of walls that are of no floor.
/// @param ground  Heights count from it.
std::vector<WallFootprint> wallFootprints(const GraphSnapshot& graph, std::optional<FloorId> floor,
                                          const Plane& ground_map);

}  // namespace mrpt_sgraphs
