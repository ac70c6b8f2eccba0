// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_palette.h"

#include <algorithm>

#include "mrpt_sgraphs/mapping/node_colour.h"

namespace mrpt_sgraphs {
namespace {

const Eigen::Vector3f kUnknown(0.55F, 0.55F, 0.55F);

template <typename Group>
Eigen::Vector3f ofGroup(const std::unordered_map<NodeId, Group>& groups, NodeId node) {
  const auto found = groups.find(node);
  return found == groups.end() ? kUnknown : colourOf(found->second);
}

}  // namespace

GraphPalette::GraphPalette(const ShownGraph& graph, ColourBy by) : graph_(graph), by_(by) {
  for (const KeyframeNode& node : graph.nodes.keyframes) {
    if (node.marginalized) dropped_.insert(node.id);
  }
  if (graph.nodes.keyframes.empty()) return;
  const auto [oldest, newest] = std::minmax_element(
      graph.nodes.keyframes.begin(), graph.nodes.keyframes.end(),
      [](const KeyframeNode& a, const KeyframeNode& b) { return a.stamp_s < b.stamp_s; });
  oldest_s_ = oldest->stamp_s;
  newest_s_ = newest->stamp_s;
}

Eigen::Vector3f GraphPalette::of(NodeId node) const {
  switch (by_) {
    case ColourBy::kLayer:
      return byLayer(node);
    case ColourBy::kRoom:
      return node.layer == Layer::kFloor ? byLayer(node) : ofGroup(graph_.room_of, node);
    case ColourBy::kFloor:
      return ofGroup(graph_.floor_of, node);
    case ColourBy::kAge:
      return byAge(node);
  }
  return kUnknown;
}

Eigen::Vector3f GraphPalette::byLayer(NodeId node) const {
  switch (node.layer) {
    case Layer::kKeyframe:
      return dropped_.count(node) != 0 ? Eigen::Vector3f(0.9F, 0.1F, 0.1F)
                                       : Eigen::Vector3f::Zero();
    case Layer::kWall:
      return {0.35F, 0.5F, 0.75F};
    case Layer::kRoom:
      return {0.95F, 0.6F, 0.15F};
    case Layer::kFloor:
      return {0.2F, 0.6F, 0.3F};
  }
  return kUnknown;
}

Eigen::Vector3f GraphPalette::byAge(NodeId node) const {
  const Eigen::Vector3f first(0.15F, 0.2F, 0.65F);
  const Eigen::Vector3f middle(0.8F, 0.2F, 0.45F);
  const Eigen::Vector3f last(0.98F, 0.8F, 0.15F);
  const auto found = graph_.first_stamp.find(node);
  if (found == graph_.first_stamp.end()) return kUnknown;
  const double whole_s = newest_s_ - oldest_s_;
  const auto share =
      static_cast<float>(whole_s > 0.0 ? (found->second - oldest_s_) / whole_s : 1.0);
  return share < 0.5F ? first + 2.0F * share * (middle - first)
                      : middle + (2.0F * share - 1.0F) * (last - middle);
}

}  // namespace mrpt_sgraphs
