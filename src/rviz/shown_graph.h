// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/SituationalGraph.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// What a factor is to the eye.
enum class TieKind : std::uint8_t {
  kOdometry,        ///< Keyframe to keyframe, also what bridges dropped ones.
  kLoopClosure,     ///< Keyframe to keyframe.
  kCondensed,       ///< From the kept keyframe to another node of a condensed factor.
  kSighting,        ///< Keyframe to wall.
  kGroundSighting,  ///< Keyframe to floor.
  kWallPair,        ///< The two faces of a wall.
};

struct Tie {
  TieKind kind;
  NodeId from;
  NodeId to;
};

/// A graph as its message tells it, and what is asked of it again and again while it is drawn.
/// Never changes.
struct ShownGraph {
  /// @throws std::invalid_argument saying in one sentence which part of the message is none and
  /// why.
  explicit ShownGraph(const SituationalGraphConstPtr& msg);

  SituationalGraphConstPtr msg;
  GraphSnapshot nodes;    ///< Without factors, clouds and planes.
  std::vector<Tie> ties;  ///< Between nodes that are there, in the order of the factors.

  std::unordered_map<NodeId, RoomId> room_of;      ///< Of keyframes, walls and rooms.
  std::unordered_map<NodeId, FloorId> floor_of;    ///< Of nodes of all layers.
  std::unordered_map<NodeId, double> first_stamp;  ///< Of the oldest keyframe at it [s].
};

using ShownGraphConstPtr = std::shared_ptr<const ShownGraph>;

}  // namespace mrpt_sgraphs
