// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A doorway as the building has it, where rooms have one each.
struct Door {
  RoomId from;  ///< The older room.
  std::optional<RoomId> to;  ///< None: leads to what is no room, or not yet.
  Eigen::Vector3d centre_map = Eigen::Vector3d::Zero();  ///< On the ground, in the opening [m].
  /// Level, a unit vector: where the wall goes on at both sides.
  Eigen::Vector3d along_map = Eigen::Vector3d::UnitX();
  double width_m = 0.0;

  Eigen::Vector3d begin_map() const { return centre_map - 0.5 * width_m * along_map; }
  Eigen::Vector3d end_map() const { return centre_map + 0.5 * width_m * along_map; }
};

/// All of them, each once: the room-to-room graph, in the order of its rooms. Which way a door lies
/// is not measured; it is that of the outline of its room at the nearest place.
std::vector<Door> doorsOf(const GraphSnapshot& graph);

/// Stairs or a ramp.
struct Stairs {
  FloorId from;
  FloorId to;
  Eigen::Vector3d from_map = Eigen::Vector3d::Zero();  ///< Where they leave the one floor [m],
  Eigen::Vector3d to_map = Eigen::Vector3d::Zero();    ///< and where they arrive on the other.
};

/// All of them, each once, though both floors tell of them.
std::vector<Stairs> stairsOf(const GraphSnapshot& graph);

}  // namespace mrpt_sgraphs
