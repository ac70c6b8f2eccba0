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
};

struct WallNode : WallAttributes {
  WallId id;
  Plane plane_map;
};

struct RoomAttributes {
  enum class Kind { kFourWalls, kCorridor, kPolygon };

  Kind kind = Kind::kFourWalls;
  std::vector<WallId> walls;
  std::optional<FloorId> floor;
  Eigen::Vector2d size_m{0.0, 0.0};  ///< Along the room's x and y, where it is rectangular.
  std::string name;
  std::vector<Eigen::Vector3d> polygon_map;  ///< Its outline on the ground [m].
};

struct RoomNode : RoomAttributes {
  RoomId id;
  Pose T_map_room = Pose::Identity();  ///< Origin: its centre on the ground; x: its heading; z: up.
};

struct FloorAttributes {
  Eigen::Vector3d centre_map{0.0, 0.0, 0.0};  ///< [m]
  std::string name;
};

struct FloorNode : FloorAttributes {
  FloorId id;
  Plane ground_map;
};

}  // namespace mrpt_sgraphs
