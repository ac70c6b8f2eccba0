// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "shown_graph.h"

#include <algorithm>
#include <unordered_set>

#include "mrpt_sgraphs/ros/detections.h"

namespace mrpt_sgraphs {
namespace {

/// None for what is drawn from the nodes themselves (a room's walls, a floor's rooms) and for what
/// holds a single node.
std::optional<TieKind> kindOf(const std::string& type, NodeId from, NodeId to) {
  if (type == "condensed") return TieKind::kCondensed;
  if (type == "loop_closure") return TieKind::kLoopClosure;
  if (type == "wall_pair") return TieKind::kWallPair;
  if (from.layer != Layer::kKeyframe) return std::nullopt;
  switch (to.layer) {
    case Layer::kKeyframe:
      return TieKind::kOdometry;
    case Layer::kWall:
      return TieKind::kSighting;
    case Layer::kFloor:
      return TieKind::kGroundSighting;
    case Layer::kRoom:
      break;
  }
  return std::nullopt;
}

NodeId nodeOf(const GraphFactor& factor, std::size_t k) {
  NodeId node;
  node.layer = static_cast<Layer>(factor.layers[k]);
  node.value = factor.nodes[k];
  return node;
}

std::unordered_set<NodeId> allNodes(const GraphSnapshot& graph) {
  std::unordered_set<NodeId> all;
  for (const KeyframeNode& node : graph.keyframes) all.insert(node.id);
  for (const WallNode& node : graph.walls) all.insert(node.id);
  for (const RoomNode& node : graph.rooms) all.insert(node.id);
  for (const FloorNode& node : graph.floors) all.insert(node.id);
  return all;
}

/// A factor of many nodes is a star around its first one.
std::vector<Tie> tiesOf(const SituationalGraph& msg, const GraphSnapshot& graph) {
  const std::unordered_set<NodeId> known = allNodes(graph);
  std::vector<Tie> ties;
  for (const GraphFactor& factor : msg.factors) {
    const std::size_t nodes = std::min(factor.layers.size(), factor.nodes.size());
    for (std::size_t k = 1; k < nodes; ++k) {
      const NodeId from = nodeOf(factor, 0);
      const NodeId to = nodeOf(factor, k);
      if (known.count(from) == 0 || known.count(to) == 0) continue;
      if (const auto kind = kindOf(factor.type, from, to)) ties.push_back({*kind, from, to});
    }
  }
  return ties;
}

/// That of the earliest.
void note(NodeId node, double stamp_s, std::unordered_map<NodeId, double>* stamps) {
  const auto [place, is_new] = stamps->emplace(node, stamp_s);
  if (!is_new) place->second = std::min(place->second, stamp_s);
}

}  // namespace

ShownGraph::ShownGraph(const SituationalGraphConstPtr& message)
    : msg(message), nodes(toSnapshot(*message)), ties(tiesOf(*message, nodes)) {
  for (const RoomNode& node : nodes.rooms) {
    room_of[node.id] = node.id;
    if (node.floor) floor_of[node.id] = *node.floor;
    for (const WallId wall : node.walls) room_of.emplace(wall, node.id);
  }
  for (const KeyframeNode& node : nodes.keyframes) {
    if (node.room) room_of[node.id] = *node.room;
    if (node.floor) floor_of[node.id] = *node.floor;
    note(node.id, node.stamp_s, &first_stamp);
    if (node.room) note(*node.room, node.stamp_s, &first_stamp);
    if (node.floor) note(*node.floor, node.stamp_s, &first_stamp);
  }
  for (const WallNode& node : nodes.walls) {
    if (node.floor) floor_of[node.id] = *node.floor;
  }
  for (const FloorNode& node : nodes.floors) floor_of[node.id] = node.id;
  for (const Tie& tie : ties) {
    if (tie.from.layer == Layer::kKeyframe && tie.to.layer == Layer::kWall) {
      note(tie.to, first_stamp.at(tie.from), &first_stamp);
    }
  }
}

}  // namespace mrpt_sgraphs
