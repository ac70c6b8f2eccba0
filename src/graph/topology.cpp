// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/topology.h"

#include <utility>

namespace mrpt_sgraphs {

void Topology::eraseNode(NodeHandle node) {
  std::vector<Links>& layer = layerOf(node);
  layer.erase(layer.begin() + static_cast<std::ptrdiff_t>(node.slot));
  for (uint32_t slot = node.slot; slot < layer.size(); ++slot) {
    for (const FactorLink& link : layer[slot]) ends_[link.slot][link.end].node.slot = slot;
  }
}

void Topology::addFactor(FactorId id, const std::vector<NodeHandle>& nodes) {
  const auto slot = static_cast<uint32_t>(ends_.size());
  Ends ends;
  for (const NodeHandle node : nodes) {
    Links& links = layerOf(node)[node.slot];
    const auto end = static_cast<uint32_t>(ends.size());
    ends.push_back({node, static_cast<uint32_t>(links.size())});
    links.push_back({id, slot, end});
  }
  ends_.push_back(std::move(ends));
}

void Topology::eraseFactor(uint32_t factor) {
  for (const FactorEnd& end : ends_[factor]) {
    Links& links = layerOf(end.node)[end.node.slot];
    const FactorLink moved = links.back();
    links[end.position] = moved;
    ends_[moved.slot][moved.end].position = end.position;
    links.pop_back();
  }
  if (factor + 1 < ends_.size()) ends_[factor] = std::move(ends_.back());
  ends_.pop_back();
  if (factor == ends_.size()) return;
  for (const FactorEnd& end : ends_[factor]) {
    layerOf(end.node)[end.node.slot][end.position].slot = factor;
  }
}

}  // namespace mrpt_sgraphs
