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

/// A room as it was built, in the truth's frame.
struct TrueRoom {
  enum class Kind { kRoom, kCorridor, kStairwell };

  uint64_t id = 0;
  std::string name;
  Kind kind = Kind::kRoom;
  PlanarExtent extent;             ///< On the ground; corners in either order.
  std::optional<double> height_m;  ///< Of the ceiling above it.
  bool entered = true;             ///< By the robot; where it is not told, it was.
};

/// A storey, in the truth's frame.
struct TrueFloor {
  uint64_t id = 0;
  double elevation_m = 0.0;
};

/// What a building.json says.
struct TrueBuilding {
  std::vector<TrueWall> walls;
  std::vector<TrueRoom> rooms;
  bool all_rooms_listed = true;  ///< Else there are others, of which nothing is told.
  std::vector<TrueFloor> floors;
  /// The walls with their doors and windows cut out, every room's floor and ceiling, and the sides
  /// and tops of the obstacles, where the file has them: else a map of furniture and pillars counts
  /// as error. Stairs do.
  std::vector<FlatSurface> surfaces;
};

/// @throws std::runtime_error naming the file and what is wrong with it.
TrueBuilding readBuilding(const std::string& path);

/// Takes rooms and floors of a building from a list of boxes instead:
///
///     [{"name": "21", "min": [x, y, z], "max": [x, y, z]}, ...]
///
/// All of them were entered. The list need not be complete; a room's id is its place in it. Boxes
/// that stand at one height within 0.3 m are one floor.
/// @throws std::runtime_error naming the file and what is wrong with it.
void readRoomBoxes(const std::string& path, TrueBuilding* building);

}  // namespace mrpt_sgraphs
