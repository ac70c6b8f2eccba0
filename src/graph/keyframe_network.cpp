// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/keyframe_network.h"

#include "mrpt_sgraphs/graph/mrpt_information.h"

namespace mrpt_sgraphs {
Pose KeyframeNetwork::pose(std::size_t slot) const {
  return fromMrpt(*nodes_[slot].T_map_base);
}

void KeyframeNetwork::setPose(std::size_t slot, const Pose& T_map_base) {
  *nodes_[slot].T_map_base = toMrpt(T_map_base);
}

void KeyframeNetwork::addNode(KeyframeId id, const Pose& T_map_base) {
  if (nodes_.empty()) network_->root = id.value;
  nodes_.push_back({id.value, &network_->nodes[id.value]});
  setPose(nodes_.size() - 1, T_map_base);
}

void KeyframeNetwork::eraseNode(std::size_t slot) {
  network_->nodes.erase(nodes_[slot].id);
  nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(slot));
  network_->root = nodes_.empty() ? mrpt::graphs::INVALID_NODEID : nodes_.front().id;
}

KeyframeNetwork::Edge KeyframeNetwork::addEdge(const RelativePoseFactor& factor) {
  Network::edge_t measurement;
  measurement.mean = toMrpt(factor.T_from_to);
  measurement.cov_inv =
      mrpt::math::CMatrixDouble66(toYawPitchRollInformation(factor.T_from_to, factor.information()));
  const auto ends = std::make_pair(factor.node(0).value, factor.node(1).value);
  return network_->edges.insert({ends, std::move(measurement)});
}

}  // namespace mrpt_sgraphs
