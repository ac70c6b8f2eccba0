// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/topology.h"

#include <utility>

namespace mrpt_sgraphs {

bool Topology::isSighting(const Ends& ends) {
  if (ends.size() != 2 || ends[0].node.layer != Layer::kKeyframe) return false;
  return ends[1].node.layer == Layer::kWall || ends[1].node.layer == Layer::kFloor;
}

void Topology::eraseNode(NodeHandle node) {
  std::vector<NodeLinks>& layer = layerOf(node);
  layer.erase(layer.begin() + static_cast<std::ptrdiff_t>(node.slot));
  for (uint32_t slot = node.slot; slot < layer.size(); ++slot) {
    for (const Links* links : {&layer[slot].sightings, &layer[slot].others}) {
      for (const FactorLink& link : *links) ends_[link.slot][link.end].node.slot = slot;
    }
  }
}

void Topology::addFactor(FactorId id, const std::vector<NodeHandle>& nodes) {
  const auto slot = static_cast<uint32_t>(ends_.size());
  Ends ends;
  for (const NodeHandle node : nodes) ends.push_back({node, 0});
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Links& links = linksOf(ends[k], ends);
    ends[k].position = static_cast<uint32_t>(links.size());
    links.push_back({id, slot, static_cast<uint32_t>(k)});
  }
  ends_.push_back(std::move(ends));
}

void Topology::eraseFactor(uint32_t factor) {
  for (const FactorEnd& end : ends_[factor]) {
    Links& links = linksOf(end, ends_[factor]);
    const FactorLink moved = links.back();
    links[end.position] = moved;
    ends_[moved.slot][moved.end].position = end.position;
    links.pop_back();
  }
  if (factor + 1 < ends_.size()) ends_[factor] = std::move(ends_.back());
  ends_.pop_back();
  if (factor == ends_.size()) return;
  for (const FactorEnd& end : ends_[factor]) {
    linksOf(end, ends_[factor])[end.position].slot = factor;
  }
}

}  // namespace mrpt_sgraphs
