// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/layered_graph.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "factor_check.h"

namespace mrpt_sgraphs {
namespace {


void requirePose(const Pose& T, NodeId node) {
  if (!isSound(T)) throw std::invalid_argument("the pose of " + nameOf(node) + " is none");
}

void requirePlane(const Plane& plane, NodeId node) {
  if (!isSound(plane)) throw std::invalid_argument("the plane of " + nameOf(node) + " is none");
}

}  // namespace

/// What `visit` makes of the nodes of a layer.
template <typename Visit>
auto LayeredGraph::inLayer(Layer layer, const Visit& visit) const {
  switch (layer) {
    case Layer::kKeyframe:
      return visit(keyframes_);
    case Layer::kWall:
      return visit(walls_);
    case Layer::kRoom:
      return visit(rooms_);
    case Layer::kFloor:
      break;
  }
  return visit(floors_);
}

KeyframeId LayeredGraph::addKeyframe(const Pose& T_map_base,
                                         const KeyframeAttributes& attributes) {
  const KeyframeId id = keyframes_.nextId();
  restoreKeyframe(id, T_map_base, attributes);
  return id;
}

WallId LayeredGraph::addWall(const Plane& plane_map, const WallAttributes& attributes) {
  const WallId id = walls_.nextId();
  restoreWall(id, plane_map, attributes);
  return id;
}

RoomId LayeredGraph::addRoom(const Pose& T_map_room, const RoomAttributes& attributes) {
  const RoomId id = rooms_.nextId();
  restoreRoom(id, T_map_room, attributes);
  return id;
}

FloorId LayeredGraph::addFloor(const Plane& ground_map, const FloorAttributes& attributes) {
  const FloorId id = floors_.nextId();
  restoreFloor(id, ground_map, attributes);
  return id;
}

void LayeredGraph::restoreKeyframe(KeyframeId id, const Pose& T_map_base,
                                       const KeyframeAttributes& attributes) {
  requirePose(T_map_base, id);
  keyframes_.add({attributes, id, T_map_base});
  network_.addNode(id, T_map_base);
  topology_.addNode(Layer::kKeyframe);
  is_moved_.push_back(false);
  snapshot_.reset();
}

void LayeredGraph::restoreWall(WallId id, const Plane& plane_map,
                                   const WallAttributes& attributes) {
  requirePlane(plane_map, id);
  walls_.add({attributes, id, plane_map});
  topology_.addNode(Layer::kWall);
  snapshot_.reset();
}

void LayeredGraph::restoreRoom(RoomId id, const Pose& T_map_room,
                                   const RoomAttributes& attributes) {
  requirePose(T_map_room, id);
  rooms_.add({attributes, id, T_map_room});
  topology_.addNode(Layer::kRoom);
  snapshot_.reset();
}

void LayeredGraph::restoreFloor(FloorId id, const Plane& ground_map,
                                    const FloorAttributes& attributes) {
  requirePlane(ground_map, id);
  floors_.add({attributes, id, ground_map});
  topology_.addNode(Layer::kFloor);
  snapshot_.reset();
}

void LayeredGraph::eraseNode(NodeId node) {
  const NodeHandle place = handle(node);
  while (!topology_.sightings(place).empty()) eraseFactor(topology_.sightings(place).back().id);
  while (!topology_.others(place).empty()) eraseFactor(topology_.others(place).back().id);
  while (!shelf_.of(node).empty()) eraseFactor(shelf_.of(node).back());
  ++erasures_;
  ++losses_;
  topology_.eraseNode(place);
  if (place.layer == Layer::kKeyframe) {
    writeMovedPoses();  // while their places are what they were
    is_moved_.pop_back();
    network_.eraseNode(place.slot);
    keyframes_.erase(place.slot);
  } else if (place.layer == Layer::kWall) {
    walls_.erase(place.slot);
  } else if (place.layer == Layer::kRoom) {
    rooms_.erase(place.slot);
  } else {
    floors_.erase(place.slot);
  }
  snapshot_.reset();
}

FactorId LayeredGraph::addFactor(FactorConstPtr factor) {
  const std::vector<NodeHandle> nodes = validated(factor);
  const FactorId id{next_factor_++};
  insertFactor(id, factor, nodes);
  for (const NodeHandle node : nodes) {
    if (node.layer != Layer::kKeyframe || !keyframes_[node.slot].marginalized) continue;
    for (const FactorId shelved : shelf_.of(nodeAt(node))) {
      if (shelf_.at(shelved).kept) broken_shelves_.insert(*shelf_.at(shelved).kept);
    }
  }
  return id;
}

void LayeredGraph::insertFactor(FactorId id, const FactorConstPtr& factor,
                                const std::vector<NodeHandle>& nodes) {
  const RelativePoseFactor* const edge = keyframeEdge(*factor);
  edges_.emplace_back();
  if (edge != nullptr) edges_.back() = network_.addEdge(*edge);
  factor_slots_[id] = static_cast<uint32_t>(factors_.size());
  factors_.push_back({id, factor});
  topology_.addFactor(id, nodes);
  snapshot_.reset();
}

void LayeredGraph::eraseFactor(FactorId id) {
  ++losses_;
  if (shelf_.contains(id)) {
    const ShelvedFactor gone = shelf_.take(id);
    if (gone.kept) broken_shelves_.insert(*gone.kept);
    snapshot_.reset();
    return;
  }
  removeFactor(id);
}

void LayeredGraph::replaceFactor(FactorId id, FactorConstPtr factor) {
  const std::vector<NodeHandle> nodes = validated(factor);
  removeFactor(id);
  insertFactor(id, factor, nodes);
}

void LayeredGraph::shelve(FactorId id, std::optional<KeyframeId> kept) {
  const FactorConstPtr factor = factors_[factorSlot(id)].factor;
  removeFactor(id);
  shelf_.add({id, factor, kept});
}

void LayeredGraph::unshelve(FactorId id) {
  const FactorConstPtr factor = shelf_.take(id).factor;
  std::vector<NodeHandle> nodes;
  for (int k = 0; k < factor->nodeCount(); ++k) nodes.push_back(handle(factor->node(k)));
  insertFactor(id, factor, nodes);
}

void LayeredGraph::setKept(FactorId id, std::optional<KeyframeId> kept) {
  shelf_.setKept(id, kept);
  snapshot_.reset();
}

void LayeredGraph::removeFactor(FactorId id) {
  const uint32_t slot = factorSlot(id);
  ++erasures_;
  if (edges_[slot]) network_.eraseEdge(*edges_[slot]);
  topology_.eraseFactor(slot);
  factor_slots_.erase(id);
  const StoredFactor last = factors_.back();
  if (last.id != id) {  // it takes the free place
    factors_.edit(slot) = last;
    edges_[slot] = edges_.back();
    factor_slots_[last.id] = slot;
  }
  factors_.pop_back();
  edges_.pop_back();
  snapshot_.reset();
}

std::vector<NodeHandle> LayeredGraph::validated(const FactorConstPtr& factor) const {
  if (factor == nullptr || factor->nodeCount() == 0) {
    throw std::invalid_argument("a factor without nodes");
  }
  std::vector<NodeHandle> nodes;
  for (int k = 0; k < factor->nodeCount(); ++k) {
    if (!contains(factor->node(k))) {
      throw std::invalid_argument(describe(*factor) + ": " + nameOf(factor->node(k)) +
                                  " is not in the graph");
    }
    nodes.push_back(handle(factor->node(k)));
  }
  std::vector<Pose> poses(nodes.size());
  std::vector<Plane> planes(nodes.size());
  std::vector<VariableView> values;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (isPlane(nodes[k].layer)) {
      planes[k] = plane(nodes[k]);
      values.emplace_back(planes[k]);
    } else {
      poses[k] = pose(nodes[k]);
      values.emplace_back(poses[k]);
    }
  }
  requireSound(*factor, values.data());
  return nodes;
}

bool LayeredGraph::contains(NodeId node) const {
  return inLayer(node.layer, [&](const auto& nodes) { return nodes.contains({node.value}); });
}

void LayeredGraph::setMapOdom(const Pose& T_map_odom) {
  T_map_odom_ = T_map_odom;
  snapshot_.reset();
}

void LayeredGraph::setAttributes(KeyframeId id, const KeyframeAttributes& attributes) {
  static_cast<KeyframeAttributes&>(keyframes_.edit(slotOf(id))) = attributes;
  snapshot_.reset();
}

void LayeredGraph::setAttributes(WallId id, const WallAttributes& attributes) {
  static_cast<WallAttributes&>(walls_.edit(slotOf(id))) = attributes;
  snapshot_.reset();
}

void LayeredGraph::setAttributes(RoomId id, const RoomAttributes& attributes) {
  static_cast<RoomAttributes&>(rooms_.edit(slotOf(id))) = attributes;
  snapshot_.reset();
}

void LayeredGraph::setAttributes(FloorId id, const FloorAttributes& attributes) {
  static_cast<FloorAttributes&>(floors_.edit(slotOf(id))) = attributes;
  snapshot_.reset();
}

std::size_t LayeredGraph::size(Layer layer) const {
  return inLayer(layer, [](const auto& nodes) { return nodes.size(); });
}

NodeHandle LayeredGraph::handle(NodeId node) const {
  return {node.layer,
          inLayer(node.layer, [&](const auto& nodes) { return nodes.slot({node.value}); })};
}

NodeId LayeredGraph::nodeAt(NodeHandle node) const {
  return inLayer(node.layer, [&](const auto& nodes) { return NodeId(nodes[node.slot].id); });
}

Pose LayeredGraph::pose(NodeHandle node) const {
  return node.layer == Layer::kKeyframe ? network_.pose(node.slot) : rooms_[node.slot].T_map_room;
}

Plane LayeredGraph::plane(NodeHandle node) const {
  return node.layer == Layer::kWall ? walls_[node.slot].plane_map : floors_[node.slot].ground_map;
}

void LayeredGraph::setPose(NodeHandle node, const Pose& T) {
  requirePose(T, nodeAt(node));
  if (node.layer == Layer::kKeyframe) {
    network_.setPose(node.slot, T);
    markMoved(node.slot);
  } else {
    rooms_.edit(node.slot).T_map_room = T;
  }
  snapshot_.reset();
}

void LayeredGraph::setPlane(NodeHandle node, const Plane& plane) {
  requirePlane(plane, nodeAt(node));
  Plane& place = node.layer == Layer::kWall ? walls_.edit(node.slot).plane_map
                                            : floors_.edit(node.slot).ground_map;
  place = plane;
  snapshot_.reset();
}

GraphSnapshotConstPtr LayeredGraph::snapshot() const {
  if (snapshot_ != nullptr) return snapshot_;
  writeMovedPoses();
  auto snapshot = std::make_shared<GraphSnapshot>();
  snapshot->T_map_odom = T_map_odom_;
  snapshot->keyframes = keyframes_.nodes();
  snapshot->walls = walls_.nodes();
  snapshot->rooms = rooms_.nodes();
  snapshot->floors = floors_.nodes();
  snapshot->factors = factors_;
  snapshot->shelved = shelf_.all();
  if (keyframes_.size() > 0) snapshot->stamp_s = keyframes_.nodes().back().stamp_s;
  snapshot_ = std::move(snapshot);
  return snapshot_;
}

uint32_t LayeredGraph::factorSlot(FactorId id) const {
  const auto found = factor_slots_.find(id);
  if (found == factor_slots_.end()) {
    throw std::out_of_range("factor " + std::to_string(id.value) + " is not in the graph");
  }
  return found->second;
}

void LayeredGraph::markMoved(uint32_t keyframe) {
  if (is_moved_[keyframe]) return;
  is_moved_[keyframe] = true;
  moved_.push_back(keyframe);
}

void LayeredGraph::writeMovedPoses() const {
  for (const uint32_t slot : moved_) {
    keyframes_.edit(slot).T_map_base = network_.pose(slot);
    is_moved_[slot] = false;
  }
  moved_.clear();
}

}  // namespace mrpt_sgraphs
