// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/plane.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// The nodes of the four layers: the estimate, which the optimizer changes, and what else is known.

struct KeyframeAttributes {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();  ///< What odometry alone said.
  Cloud::ConstPtr cloud;                ///< Base frame.
  ObservedPlanesConstPtr planes;        ///< What was flat in it; may be null.
  std::optional<FloorId> floor;
  std::optional<RoomId> room;
  bool marginalized = false;                 ///< Dropped from the optimization.
  std::optional<KeyframeId> representative;  ///< The kept one that it moves with; none: itself.
};

struct KeyframeNode : KeyframeAttributes {
  KeyframeId id;
  Pose T_map_base = Pose::Identity();
};

/// A surface seen from one side.
struct WallAttributes {
  PlanarExtent extent_map;  ///< How far it was seen.
  std::optional<FloorId> floor;
};

struct WallNode : WallAttributes {
  WallId id;
  Plane plane_map;
};

/// A way out of a room: a door, or where a narrow passage opens into it.
struct Doorway {
  std::optional<RoomId> to;  ///< None: leads to what is no room, or not yet.
  Eigen::Vector3d centre_map = Eigen::Vector3d::Zero();  ///< On the ground, in the opening [m].
  double width_m = 0.0;
};

struct RoomAttributes {
  /// A stairwell is what lies around stairs on the level of its floor. The flights are connections
  /// of floors, and what is on them is in no room.
  enum class Kind { kFourWalls, kCorridor, kPolygon, kStairwell };

  Kind kind = Kind::kFourWalls;
  std::vector<WallId> walls;
  std::optional<FloorId> floor;
  Eigen::Vector2d size_m{0.0, 0.0};  ///< Along the room's x and y, where it is rectangular.
  std::string name;
  PlanarExtent extent_map;  ///< On the ground, counter-clockwise as seen from above.
  double height_m = 0.0;    ///< Above the ground: where its walls were seen highest; 0: none.
  std::vector<Doorway> doorways;
};

struct RoomNode : RoomAttributes {
  RoomId id;
  Pose T_map_room = Pose::Identity();  ///< Origin: its centre on the ground; x: its heading; z: up.
};

/// Stairs or a ramp from one floor to another.
struct FloorConnection {
  FloorId to;
  Eigen::Vector3d here_map = Eigen::Vector3d::Zero();   ///< Where it leaves this floor [m],
  Eigen::Vector3d there_map = Eigen::Vector3d::Zero();  ///< and where it arrives on the other.

  friend bool operator==(const FloorConnection& a, const FloorConnection& b) {
    return a.to == b.to && a.here_map == b.here_map && a.there_map == b.there_map;
  }
};

struct FloorAttributes {
  Eigen::Vector3d centre_map{0.0, 0.0, 0.0};  ///< [m]
  std::string name;
  std::vector<FloorConnection> connections;

  friend bool operator==(const FloorAttributes& a, const FloorAttributes& b) {
    return a.centre_map == b.centre_map && a.name == b.name && a.connections == b.connections;
  }
};

struct FloorNode : FloorAttributes {
  FloorId id;
  Plane ground_map;
};

}  // namespace mrpt_sgraphs
