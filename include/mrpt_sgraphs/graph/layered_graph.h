// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/graph/factor_shelf.h"
#include "mrpt_sgraphs/graph/keyframe_network.h"
#include "mrpt_sgraphs/graph/layer_nodes.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/graph/topology.h"

namespace mrpt_sgraphs {

/// The four layers and everything that is known between them, in one factor graph.
///
/// The keyframes layer is a network of MRPT: their poses are kept there and nowhere else, and its
/// edges come and go with the relative poses between keyframes, so both views are always one.
///
/// Belongs to one thread; others read its snapshots. Nodes are named by their ids for ever; handles
/// are their places, for what walks the whole graph.
class LayeredGraph {
 public:
  using Network = KeyframeNetwork::Network;

  /// Nodes: `add` gives the next id of the layer, `restore` takes one from a file.
  /// @throws std::invalid_argument for a pose or plane that is none (not finite; no rotation, no
  /// unit
  ///         normal, within 1e-6), and for an id that another node has or had.
  KeyframeId addKeyframe(const Pose& T_map_base, const KeyframeAttributes& attributes);
  WallId addWall(const Plane& plane_map, const WallAttributes& attributes);
  RoomId addRoom(const Pose& T_map_room, const RoomAttributes& attributes);
  FloorId addFloor(const Plane& ground_map, const FloorAttributes& attributes);
  void restoreKeyframe(KeyframeId id, const Pose& T_map_base, const KeyframeAttributes& attributes);
  void restoreWall(WallId id, const Plane& plane_map, const WallAttributes& attributes);
  void restoreRoom(RoomId id, const Pose& T_map_room, const RoomAttributes& attributes);
  void restoreFloor(FloorId id, const Plane& ground_map, const FloorAttributes& attributes);

  /// Erases the node and its factors, in proportion to the layer. Its id is not given again.
  void eraseNode(NodeId node);

  /// @throws std::invalid_argument naming the nodes: if one is not in the graph or is there twice,
  /// if
  ///         the factor's cost and its derivatives are not finite where the nodes are, or are not
  ///         those of a positive semidefinite information.
  FactorId addFactor(FactorConstPtr factor);
  void eraseFactor(FactorId id);
  /// Another factor under the same id. Throws as to add it does, and nothing has changed then.
  void replaceFactor(FactorId id, FactorConstPtr factor);

  /// Takes a factor out of the optimization for another one that stands for it, and back again. It
  /// keeps its id, and is found and erased by it as before; only the topology does not know it.
  /// @param kept  Whose condensed factor it is in from now on; none: a transferred edge.
  void shelve(FactorId id, std::optional<KeyframeId> kept);
  void unshelve(FactorId id);
  const FactorShelf& shelf() const { return shelf_; }
  /// Kept keyframes whose condensed factors do not say any more what the factors of their dropped
  /// keyframes say: some were erased, or have come.
  const std::set<KeyframeId>& brokenShelves() const { return broken_shelves_; }
  void setMended(KeyframeId kept) { broken_shelves_.erase(kept); }
  void setKept(FactorId id, std::optional<KeyframeId> kept);

  /// What is asked for by an id throws std::out_of_range if that is not in the graph.
  bool contains(NodeId node) const;
  /// Also of one that is shelved.
  bool contains(FactorId id) const {
    return factor_slots_.count(id) != 0 || shelf_.contains(id);
  }
  const FactorConstPtr& factor(FactorId id) const {
    return shelf_.contains(id) ? shelf_.at(id).factor : factors_[factorSlot(id)].factor;
  }
  /// In no order that means anything; neither copies nor searches. See Topology for the two kinds.
  const Topology::Links& sightingsOf(NodeId node) const {
    return topology_.sightings(handle(node));
  }
  const Topology::Links& otherFactorsOf(NodeId node) const { return topology_.others(handle(node)); }
  std::size_t factorCountOf(NodeId node) const { return topology_.linkCount(handle(node)); }

  /// Estimates. To set one throws as to add it does.
  Pose pose(KeyframeId id) const { return pose(handle(id)); }
  Pose pose(RoomId id) const { return pose(handle(id)); }
  Plane plane(WallId id) const { return plane(handle(id)); }
  Plane plane(FloorId id) const { return plane(handle(id)); }
  void setPose(KeyframeId id, const Pose& T_map_base) { setPose(handle(id), T_map_base); }
  void setPose(RoomId id, const Pose& T_map_room) { setPose(handle(id), T_map_room); }
  void setPlane(WallId id, const Plane& plane_map) { setPlane(handle(id), plane_map); }
  void setPlane(FloorId id, const Plane& ground_map) { setPlane(handle(id), ground_map); }
  const Pose& T_map_odom() const { return T_map_odom_; }
  void setMapOdom(const Pose& T_map_odom);

  /// All but the estimates.
  const KeyframeAttributes& attributes(KeyframeId id) const { return keyframes_[slotOf(id)]; }
  const WallAttributes& attributes(WallId id) const { return walls_[slotOf(id)]; }
  const RoomAttributes& attributes(RoomId id) const { return rooms_[slotOf(id)]; }
  const FloorAttributes& attributes(FloorId id) const { return floors_[slotOf(id)]; }
  void setAttributes(KeyframeId id, const KeyframeAttributes& attributes);
  void setAttributes(WallId id, const WallAttributes& attributes);
  void setAttributes(RoomId id, const RoomAttributes& attributes);
  void setAttributes(FloorId id, const FloorAttributes& attributes);

  /// By places, from 0 on and without gaps, in the order in which the nodes came; a handle that is
  /// none is undefined behaviour. Poses are of keyframes and rooms, planes of walls and floors.
  std::size_t size(Layer layer) const;
  std::size_t factorCount() const { return factors_.size(); }
  NodeHandle handle(NodeId node) const;
  NodeId nodeAt(NodeHandle node) const;
  Pose pose(NodeHandle node) const;
  Plane plane(NodeHandle node) const;
  void setPose(NodeHandle node, const Pose& T);
  void setPlane(NodeHandle node, const Plane& plane);
  const StoredFactor& factorAt(uint32_t slot) const { return factors_[slot]; }
  const Topology& topology() const { return topology_; }
  /// How often a node or factor has lost its place: places that are remembered are good while it
  /// stands.
  uint64_t erasures() const { return erasures_; }
  /// How often a node or factor was erased: ids that are remembered are good while it stands.
  uint64_t losses() const { return losses_; }

  /// To be handed to MRPT.
  const Network& network() const { return network_.network(); }

  /// What the graph is now: the same object until it changes. Costs in proportion to what has
  /// changed since the last one, but for a pointer for every 256 nodes and factors.
  GraphSnapshotConstPtr snapshot() const;

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  /// Read into an empty graph. Which factors a node has is kept in their order.
  template <typename Archive>
  void archive(Archive& a);

 private:
  uint32_t slotOf(KeyframeId id) const { return keyframes_.slot(id); }
  uint32_t slotOf(WallId id) const { return walls_.slot(id); }
  uint32_t slotOf(RoomId id) const { return rooms_.slot(id); }
  uint32_t slotOf(FloorId id) const { return floors_.slot(id); }
  template <typename Visit>
  auto inLayer(Layer layer, const Visit& visit) const;
  uint32_t factorSlot(FactorId id) const;
  std::vector<NodeHandle> validated(const FactorConstPtr& factor) const;
  void insertFactor(FactorId id, const FactorConstPtr& factor,
                    const std::vector<NodeHandle>& nodes);
  void removeFactor(FactorId id);
  void markMoved(uint32_t keyframe);
  void writeMovedPoses() const;

  KeyframeNetwork network_;
  mutable LayerNodes<KeyframeNode> keyframes_;  ///< Poses are those of the last snapshot.
  LayerNodes<WallNode> walls_;
  LayerNodes<RoomNode> rooms_;
  LayerNodes<FloorNode> floors_;
  SharedVector<StoredFactor> factors_;
  std::vector<std::optional<KeyframeNetwork::Edge>> edges_;  ///< Of each factor, in the network.
  std::unordered_map<FactorId, uint32_t> factor_slots_;
  Topology topology_;
  FactorShelf shelf_;
  std::set<KeyframeId> broken_shelves_;
  uint64_t next_factor_ = 0;
  uint64_t erasures_ = 0;
  uint64_t losses_ = 0;
  Pose T_map_odom_ = Pose::Identity();

  mutable std::vector<uint32_t> moved_;     ///< Slots of keyframes, since the last snapshot.
  mutable std::vector<bool> is_moved_;      ///< By slot.
  mutable GraphSnapshotConstPtr snapshot_;  ///< Null after a change.
};

}  // namespace mrpt_sgraphs
