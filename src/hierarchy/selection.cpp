// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/selection.h"

#include <algorithm>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "node_set.h"

namespace mrpt_sgraphs {
namespace {

constexpr Layer kLayers[] = {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor};

void addSeen(const LayeredGraph& graph, NodeHandle keyframe, Layer layer, NodeSet* nodes) {
  for (const FactorLink& link : graph.topology().sightings(keyframe)) {
    const NodeHandle surface = graph.topology().ends(link.slot)[1].node;
    if (surface.layer == layer) nodes->add(surface);
  }
}

/// Some may have been merged since the room was detected.
std::vector<WallId> wallsOf(const LayeredGraph& graph, RoomId room) {
  std::vector<WallId> walls;
  for (const WallId wall : graph.attributes(room).walls) {
    if (graph.contains(wall)) walls.push_back(wall);
  }
  return walls;
}

/// The free nodes, and what they are tied to stays. Something has to: if there is no pose among it,
/// the keyframe that is the first of the free ones.
Selection completed(const LayeredGraph& graph, const NodeSet& free) {
  const Topology& topology = graph.topology();
  NodeSet fixed;
  bool is_held = false;
  const auto addNeighbours = [&](const Topology::Links& links) {
    for (const FactorLink& link : links) {
      for (const FactorEnd& end : topology.ends(link.slot)) {
        if (free.contains(end.node)) continue;
        fixed.add(end.node);
        if (!isPlane(end.node.layer)) is_held = true;
      }
    }
  };
  std::optional<NodeHandle> first;
  for (const NodeHandle node : free.nodes()) {
    addNeighbours(topology.sightings(node));
    addNeighbours(topology.others(node));
    const bool is_first =
        node.layer == Layer::kKeyframe && (!first || node.slot < first->slot);
    if (is_first) first = node;
  }
  Selection selection;
  for (const NodeHandle node : free.nodes()) {
    if (topology.linkCount(node) == 0) continue;  // nothing is known of it
    // the first keyframe of all stays in any case, so that the map does
    const bool stays = first && node == *first && (!is_held || node.slot == 0);
    (stays ? selection.fixed : selection.free).push_back(graph.nodeAt(node));
  }
  for (const NodeHandle node : fixed.nodes()) selection.fixed.push_back(graph.nodeAt(node));
  return selection;
}

}  // namespace

Selection selectAll(const LayeredGraph& graph) {
  Selection all;
  for (const Layer layer : kLayers) {
    for (uint32_t slot = 0; slot < graph.size(layer); ++slot) {
      const NodeHandle node{layer, slot};
      if (graph.topology().linkCount(node) == 0) continue;
      const bool first_keyframe = layer == Layer::kKeyframe && slot == 0;
      (first_keyframe ? all.fixed : all.free).push_back(graph.nodeAt(node));
    }
  }
  return all;
}

bool isWithin(const LayeredGraph& graph, RoomId room, const Eigen::Vector3d& point_map) {
  const RoomAttributes& attributes = graph.attributes(room);
  const Outline3& outline = attributes.extent_map.outline;
  if (attributes.kind != RoomAttributes::Kind::kFourWalls && outline.size() >= 3) {
    const PlaneFrame frame(Plane{}, outline.front());
    return contains(flattened(attributes.extent_map, frame), frame.flat(point_map));
  }
  const Eigen::Vector3d centre_map = graph.pose(room).translation();
  const std::vector<WallId> walls = wallsOf(graph, room);
  return std::all_of(walls.begin(), walls.end(), [&](WallId id) {
    const Plane wall = graph.plane(id);
    const double side = wall.normal.dot(centre_map) - wall.distance;
    return side * (wall.normal.dot(point_map) - wall.distance) > 0.0;
  });
}

Selection selectRoom(const LayeredGraph& graph, RoomId room) {
  const Topology& topology = graph.topology();
  const RoomAttributes& attributes = graph.attributes(room);
  // who sees none of its walls is not in it
  NodeSet inside;
  for (const WallId wall : wallsOf(graph, room)) {
    for (const FactorLink& link : topology.sightings(graph.handle(wall))) {
      const NodeHandle node = topology.ends(link.slot)[0].node;
      const KeyframeAttributes& keyframe = graph.attributes(KeyframeId{graph.nodeAt(node).value});
      const bool is_in = keyframe.room
                             ? *keyframe.room == room
                             : (!keyframe.floor || keyframe.floor == attributes.floor) &&
                                   isWithin(graph, room, graph.pose(node).translation());
      if (is_in) inside.add(node);
    }
  }
  NodeSet free = inside;
  for (const NodeHandle keyframe : inside.nodes()) addSeen(graph, keyframe, Layer::kWall, &free);
  for (const WallId wall : wallsOf(graph, room)) free.add(graph.handle(wall));
  free.add(graph.handle(room));
  if (attributes.floor && graph.contains(*attributes.floor)) {
    free.add(graph.handle(*attributes.floor));
  }
  return completed(graph, free);
}

Selection selectFloor(const LayeredGraph& graph, FloorId floor) {
  NodeSet free;
  for (const Layer layer : kLayers) {
    for (uint32_t slot = 0; slot < graph.size(layer); ++slot) {
      const NodeHandle node{layer, slot};
      if (graph.topology().linkCount(node) == 0) continue;
      const NodeId id = graph.nodeAt(node);
      const bool is_on = layer == Layer::kKeyframe
                             ? graph.attributes(KeyframeId{id.value}).floor == floor
                         : layer == Layer::kWall ? graph.attributes(WallId{id.value}).floor == floor
                         : layer == Layer::kRoom ? graph.attributes(RoomId{id.value}).floor == floor
                                                 : id == NodeId(floor);
      if (!is_on) continue;
      free.add(node);
      if (layer == Layer::kKeyframe) addSeen(graph, node, Layer::kWall, &free);
    }
  }
  return completed(graph, free);
}

}  // namespace mrpt_sgraphs
