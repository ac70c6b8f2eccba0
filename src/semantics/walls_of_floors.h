// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/nodes.h"

namespace mrpt_sgraphs {

/// Where a robot stood on a level.
struct LevelPlace {
  Eigen::Vector3d base_map = Eigen::Vector3d::Zero();  ///< [m]
  Plane ground_map;
  std::size_t level = 0;
};
using LevelPlaces = std::vector<LevelPlace>;

/// The level of the place that sees the wall from nearest by: in front of it, above no wall that
/// ends below its ground, and rather beside than below the wall. Who saw it in truth is not asked,
/// so that a graph without factors tells the same.
/// @return None for a wall without an extent, or that no place is in front of.
std::optional<std::size_t> floorOfWall(const WallNode& wall, const LevelPlaces& places);

}  // namespace mrpt_sgraphs
