// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// What a file of a graph says: values to begin with, and factors between them. Every id is there
/// once, and every node that something names is there.
struct GraphFile {
  struct Keyframe {
    KeyframeId id;
    Pose T_map_base = Pose::Identity();
    bool fixed = false;           ///< The file says so.
    std::optional<RoomId> room;   ///< That it stands in.
    std::optional<FloorId> floor;
  };
  struct Wall {
    WallId id;
    Plane plane_map;  ///< Seen from within the room, as everywhere in this package.
  };
  struct Room {
    RoomId id;
    FloorId floor;
    Eigen::Vector2d centre_map = Eigen::Vector2d::Zero();  ///< [m]
    std::vector<WallId> walls;
  };
  struct Floor {
    FloorId id;
    Eigen::Vector2d centre_map = Eigen::Vector2d::Zero();  ///< [m]
  };

  /// All in the order of the file.
  std::vector<Keyframe> keyframes;
  std::vector<Wall> walls;
  std::vector<Room> rooms;
  std::vector<Floor> floors;
  std::vector<FactorConstPtr> factors;

  std::map<std::string, int> ignored;  ///< Records that we do not know, and how many there were.
};

}  // namespace mrpt_sgraphs
