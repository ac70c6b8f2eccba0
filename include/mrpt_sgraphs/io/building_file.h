// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/io/map_error.h"

namespace mrpt_sgraphs {

/// A wall face as it was built, in the truth's frame.
struct TrueWall {
  uint64_t id = 0;
  std::optional<Plane> plane;     ///< Its normal points into the room; none where no side is told.
  PlanarExtent extent;            ///< Corners in either order.
  std::optional<double> seen_m2;  ///< How much of it the sensor saw from near; none where not told.
};

/// What a building.json says.
struct TrueBuilding {
  std::vector<TrueWall> walls;
  /// The walls with their doors and windows cut out, and every room's floor and ceiling. Furniture,
  /// pillars and stairs are not in that file: a map of them counts as error.
  std::vector<FlatSurface> surfaces;
};

/// @throws std::runtime_error naming the file and what is wrong with it.
TrueBuilding readBuilding(const std::string& path);

}  // namespace mrpt_sgraphs
