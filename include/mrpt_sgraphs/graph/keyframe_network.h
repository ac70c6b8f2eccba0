// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/graph/mrpt_network.h"

namespace mrpt_sgraphs {

/// The keyframes layer as MRPT sees it, and the one place where the keyframes' poses are kept.
class KeyframeNetwork {
 public:
  using Network = MrptNetwork;
  using Edge = Network::iterator;  ///< Stable: MRPT's edges are a multimap.

  const Network& network() const { return *network_; }

  /// Poses by the keyframe's slot, and bit by bit as they were set.
  Pose pose(std::size_t slot) const;
  void setPose(std::size_t slot, const Pose& T_map_base);

  /// A keyframe in the last slot. The network's root is that in the first.
  void addNode(KeyframeId id, const Pose& T_map_base);

  /// One without edges. The slots above it move down by one.
  void eraseNode(std::size_t slot);

  Edge addEdge(const RelativePoseFactor& factor);
  void eraseEdge(Edge edge) { network_->edges.erase(edge); }

 private:
  struct Node {
    mrpt::graphs::TNodeID id;
    mrpt::poses::CPose3D* T_map_base;  ///< Stable: MRPT's nodes are a map.
  };
  std::unique_ptr<Network> network_ = std::make_unique<Network>();
  std::vector<Node> nodes_;  ///< By slot.
};

}  // namespace mrpt_sgraphs
