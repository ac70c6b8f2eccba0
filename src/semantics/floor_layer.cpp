// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/floor_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace mrpt_sgraphs {
namespace {

using FloorOfKeyframe = std::map<KeyframeId, FloorId>;

/// Only where it is another one: what is not written stays shared with the snapshots.
template <typename NodeIdType>
void setFloor(NodeIdType id, const std::optional<FloorId>& floor, LayeredGraph* graph) {
  if (graph->attributes(id).floor == floor) return;
  auto attributes = graph->attributes(id);
  attributes.floor = floor;
  graph->setAttributes(id, attributes);
}

bool merge(FloorId stays, FloorId goes, GroundLayer* ground, LayeredGraph* graph) {
  if (!ground->merge(stays, goes, graph)) return false;
  const GraphSnapshotConstPtr now = graph->snapshot();
  for (const KeyframeNode& node : now->keyframes) {
    if (node.floor == goes) setFloor(node.id, stays, graph);
  }
  for (const WallNode& node : now->walls) {
    if (node.floor == goes) setFloor(node.id, stays, graph);
  }
  for (const RoomNode& node : now->rooms) {
    if (node.floor == goes) setFloor(node.id, stays, graph);
  }
  return true;
}

/// Keyframes that the detection has seen stand where it says, or on no level at all. One that has
/// got a level since then which it does not know keeps it.
void setFloorsOfKeyframes(const FloorDetection& detection, LayeredGraph* graph) {
  FloorOfKeyframe floor_of;
  std::set<FloorId> known;
  for (const DetectedFloor& floor : detection.floors) {
    known.insert(floor.id);
    if (!graph->contains(floor.id)) continue;
    for (const KeyframeId id : floor.keyframes) floor_of[id] = floor.id;
  }
  const GraphSnapshotConstPtr now = graph->snapshot();
  for (const KeyframeNode& node : now->keyframes) {
    if (node.stamp_s > detection.stamp_s) break;
    const auto found = floor_of.find(node.id);
    if (found != floor_of.end()) {
      setFloor(node.id, found->second, graph);
    } else if (node.floor && known.count(*node.floor) != 0) {
      setFloor(node.id, std::nullopt, graph);
    }
  }
}

Eigen::Vector3d onGround(const Plane& ground_map, const Eigen::Vector3d& point_map) {
  return point_map - (ground_map.normal.dot(point_map) - ground_map.distance) * ground_map.normal;
}

/// Where stairs leave a level: under that of their keyframes that is nearest to its height.
Eigen::Vector3d endOf(const std::vector<KeyframeId>& stairs, const Plane& ground_map,
                      const LayeredGraph& graph) {
  Eigen::Vector3d end_map = Eigen::Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const KeyframeId id : stairs) {
    const Eigen::Vector3d base_map = graph.pose(id).translation();
    const double off_m = std::abs(ground_map.normal.dot(base_map) - ground_map.distance);
    if (off_m >= least) continue;
    least = off_m;
    end_map = onGround(ground_map, base_map);
  }
  return end_map;
}

std::map<FloorId, std::vector<FloorConnection>> connectionsIn(const FloorDetection& detection,
                                                              const LayeredGraph& graph) {
  std::map<FloorId, std::vector<FloorConnection>> connections;
  for (const DetectedConnection& detected : detection.connections) {
    if (!graph.contains(detected.from) || !graph.contains(detected.to)) continue;
    std::vector<KeyframeId> stairs;
    for (const KeyframeId id : detected.keyframes) {
      if (graph.contains(id)) stairs.push_back(id);
    }
    if (stairs.empty()) continue;
    const Eigen::Vector3d from_map = endOf(stairs, graph.plane(detected.from), graph);
    const Eigen::Vector3d to_map = endOf(stairs, graph.plane(detected.to), graph);
    connections[detected.from].push_back({detected.to, from_map, to_map});
    connections[detected.to].push_back({detected.from, to_map, from_map});
  }
  return connections;
}

/// The keyframes' middle, on the ground.
Eigen::Vector3d centreOf(const std::vector<KeyframeId>& keyframes, const Plane& ground_map,
                         const LayeredGraph& graph) {
  Eigen::Vector3d sum_map = Eigen::Vector3d::Zero();
  for (const KeyframeId id : keyframes) sum_map += graph.pose(id).translation();
  return onGround(ground_map, sum_map / static_cast<double>(keyframes.size()));
}

}  // namespace

bool updateFloors(const FloorDetection& detection, GroundLayer* ground, LayeredGraph* graph) {
  bool changed = false;
  for (const auto& [older, younger] : detection.same) {
    if (merge(older, younger, ground, graph)) changed = true;
  }
  setFloorsOfKeyframes(detection, graph);
  const auto connections = connectionsIn(detection, *graph);
  for (const DetectedFloor& floor : detection.floors) {
    if (!graph->contains(floor.id)) continue;
    for (const WallId wall : floor.walls) {
      // those that keyframes of a level see are told by them, and know it better
      const bool is_new = graph->contains(wall) && !graph->attributes(wall).floor;
      if (is_new) setFloor(wall, floor.id, graph);
    }
    std::vector<KeyframeId> keyframes;
    for (const KeyframeId id : floor.keyframes) {
      if (graph->contains(id)) keyframes.push_back(id);
    }
    FloorAttributes attributes = graph->attributes(floor.id);
    // in the order of discovery: from the bottom up, a cellar would rename all that are above it
    if (attributes.name.empty()) attributes.name = "floor " + std::to_string(floor.id.value + 1);
    if (!keyframes.empty()) {
      attributes.centre_map = centreOf(keyframes, graph->plane(floor.id), *graph);
    }
    const auto found = connections.find(floor.id);
    attributes.connections =
        found == connections.end() ? std::vector<FloorConnection>() : found->second;
    if (!(attributes == graph->attributes(floor.id))) graph->setAttributes(floor.id, attributes);
  }
  return changed;
}

}  // namespace mrpt_sgraphs
