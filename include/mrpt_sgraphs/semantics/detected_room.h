// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/nodes.h"

namespace mrpt_sgraphs {

/// A wall that bounds a room.
struct BoundingWall {
  WallId id;
  /// Where its normal points, in the room: a horizontal unit vector.
  Eigen::Vector3d axis_room = Eigen::Vector3d::UnitX();

  template <typename Archive>
  void archive(Archive& a) {
    a("id", id);
    a("axis_room", axis_room);
  }
};

/// A way out of a room.
struct DetectedDoorway {
  std::optional<std::size_t> to;  ///< Among the rooms of the same detection; none: to what is none.
  Eigen::Vector3d centre_anchor = Eigen::Vector3d::Zero();  ///< On the ground, in the opening [m].
  double width_m = 0.0;

  template <typename Archive>
  void archive(Archive& a) {
    a("to", to);
    a("centre_anchor", centre_anchor);
    a("width_m", width_m);
  }
};

/// A room as it was found in the graph of some moment. Everything is told in the frame of one of
/// its keyframes, so that it stays right when the graph has moved since.
struct DetectedRoom {
  KeyframeId anchor;  ///< The first of `keyframes`.
  Pose T_anchor_room = Pose::Identity();
  RoomAttributes::Kind kind = RoomAttributes::Kind::kPolygon;
  std::optional<FloorId> floor;
  Eigen::Vector2d size_m{0.0, 0.0};  ///< Along the room's x and y: of the box around the outline.
  PlanarExtent extent_anchor;        ///< On the ground, counter-clockwise as seen from above.
  double height_m = 0.0;             ///< Above the ground: where its walls were seen highest.
  std::vector<BoundingWall> walls;
  std::vector<KeyframeId> keyframes;  ///< Inside of it, in their order; at least one.
  std::vector<DetectedDoorway> doorways;

  template <typename Archive>
  void archive(Archive& a) {
    a("anchor", anchor);
    a("T_anchor_room", T_anchor_room);
    a("kind", kind);
    a("floor", floor);
    a("size_m", size_m);
    a("extent_anchor", extent_anchor);
    a("height_m", height_m);
    a("walls", walls);
    a("keyframes", keyframes);
    a("doorways", doorways);
  }
};

/// All rooms that there are.
struct RoomDetection {
  double stamp_s = 0.0;  ///< Of the newest keyframe that it knows of.
  std::vector<DetectedRoom> rooms;
};

}  // namespace mrpt_sgraphs
