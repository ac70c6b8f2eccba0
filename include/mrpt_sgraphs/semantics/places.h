// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// Where a place lies in the building, by what the graph says now. All places in `map` [m].

/// Whether the room's outline goes around the place as seen from above; heights do not count.
bool isAround(const RoomNode& room, const Eigen::Vector3d& place_map);

/// Its ground as seen from above, without holes [m^2].
double areaOf(const RoomNode& room);

/// The point of a room's outline that is the nearest as seen from above.
struct RoomBorder {
  Eigen::Vector3d nearest_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_map = Eigen::Vector3d::UnitX();  ///< Of the outline there; level, unit.
  double distance_m = 0.0;                               ///< Level.
};
/// Nothing for a room without an outline.
std::optional<RoomBorder> nearestBorder(const RoomNode& room, const Eigen::Vector3d& place_map);

/// A place in the building. The pointers are into the graph.
struct Place {
  /// The storey of the room, else the highest one whose ground is not above the place. Null: the
  /// graph has none there.
  const FloorNode* floor = nullptr;
  const RoomNode* room = nullptr;     ///< Null: it is in none.
  const RoomNode* nearest = nullptr;  ///< Of those of the storey, if it is in none.
  double distance_m = 0.0;            ///< To that one, level.
};

/// The room is the one whose outline goes around the place, on whose storey the place is: from a
/// step below its ground to a step above where its walls were seen highest.
Place placeOf(const GraphSnapshot& graph, const Eigen::Vector3d& place_map);

/// All of that name, to the letter.
std::vector<const RoomNode*> roomsNamed(const GraphSnapshot& graph, const std::string& name);

/// Null where there is none.
const RoomNode* findRoom(const GraphSnapshot& graph, RoomId id);
const FloorNode* findFloor(const GraphSnapshot& graph, FloorId id);

}  // namespace mrpt_sgraphs
