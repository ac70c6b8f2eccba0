// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/doors.h"

#include <algorithm>

#include "mrpt_sgraphs/semantics/places.h"

namespace mrpt_sgraphs {
namespace {

/// Rooms may have the two sides of a thick wall for the same doorway.
constexpr double kSameDoorway_m = 1.0;
constexpr double kSameStairs_m = 1.0;  ///< Ends of stairs that are nearer are those of one.

bool isSame(const Door& door, RoomId from, const Doorway& doorway) {
  return door.to == from && doorway.to == door.from &&
         (door.centre_map - doorway.centre_map).norm() < kSameDoorway_m;
}

}  // namespace

std::vector<Door> doorsOf(const GraphSnapshot& graph) {
  std::vector<Door> doors;
  for (const RoomNode& room : graph.rooms) {
    for (const Doorway& doorway : room.doorways) {
      const bool is_known = std::any_of(doors.begin(), doors.end(), [&](const Door& door) {
        return isSame(door, room.id, doorway);
      });
      if (is_known) continue;
      const auto border = nearestBorder(room, doorway.centre_map);
      doors.push_back({room.id, doorway.to, doorway.centre_map,
                       border ? border->along_map : Eigen::Vector3d(Eigen::Vector3d::UnitX()),
                       doorway.width_m});
    }
  }
  return doors;
}

std::vector<Stairs> stairsOf(const GraphSnapshot& graph) {
  std::vector<Stairs> all;
  for (const FloorNode& floor : graph.floors) {
    for (const FloorConnection& connection : floor.connections) {
      const bool is_known = std::any_of(all.begin(), all.end(), [&](const Stairs& stairs) {
        return stairs.to == floor.id && stairs.from == connection.to &&
               (stairs.to_map - connection.here_map).norm() < kSameStairs_m;
      });
      if (is_known) continue;
      all.push_back({floor.id, connection.to, connection.here_map, connection.there_map});
    }
  }
  return all;
}

}  // namespace mrpt_sgraphs
