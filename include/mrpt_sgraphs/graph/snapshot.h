// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/graph/factor_shelf.h"
#include "mrpt_sgraphs/graph/nodes.h"
#include "mrpt_sgraphs/graph/shared_vector.h"

namespace mrpt_sgraphs {

/// A factor and its name.
struct StoredFactor {
  FactorId id;
  FactorConstPtr factor;
};

/// The factor if it is a relative pose between two keyframes, an edge of the keyframes layer; null
/// if it is something else.
inline const RelativePoseFactor* keyframeEdge(const Factor& factor) {
  const auto* edge = dynamic_cast<const RelativePoseFactor*>(&factor);
  const bool between_keyframes = edge != nullptr && edge->node(0).layer == Layer::kKeyframe &&
                                 edge->node(1).layer == Layer::kKeyframe;
  return between_keyframes ? edge : nullptr;
}

/// The graph as it was at one moment; never changes, shared between threads. What did not change
/// from one to the next is one object in both.
struct GraphSnapshot {
  double stamp_s = 0.0;  ///< Of the last keyframe.
  Pose T_map_odom = Pose::Identity();
  SharedVector<KeyframeNode> keyframes;  ///< In the order in which they came, as the other layers.
  SharedVector<WallNode> walls;
  SharedVector<RoomNode> rooms;
  SharedVector<FloorNode> floors;
  SharedVector<StoredFactor>
      factors;  ///< In the order in which they came as long as none was erased.
  SharedVector<ShelvedFactor> shelved;
};

using GraphSnapshotConstPtr = std::shared_ptr<const GraphSnapshot>;

}  // namespace mrpt_sgraphs
