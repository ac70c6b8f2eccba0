// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/graph/shared_vector.h"

namespace mrpt_sgraphs {

/// The nodes of one layer: in the order in which they came, found by their ids. No id is taken
/// twice, also not after its node was erased.
template <typename Node>
class LayerNodes {
 public:
  using NodeIdType = decltype(Node::id);

  /// The largest number is no id: MRPT and the messages take it for "none".
  static constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

  std::size_t size() const { return nodes_.size(); }
  const SharedVector<Node>& nodes() const { return nodes_; }
  const Node& operator[](std::size_t slot) const { return nodes_[slot]; }
  Node& edit(std::size_t slot) { return nodes_.edit(slot); }

  /// Above all ids that ever were.
  /// @throws std::length_error if there is none.
  NodeIdType nextId() const {
    if (next_id_ == kNone) throw std::length_error("the ids of a layer are used up");
    return NodeIdType{next_id_};
  }

  /// @throws std::invalid_argument if the id is, or was, another node's, or is none.
  void add(Node node) {
    const uint64_t id = node.id.value;
    if (id == kNone)
      throw std::invalid_argument(nameOf(NodeId(node.id)) + ": no number for a node");
    if (!slots_.emplace(id, static_cast<uint32_t>(nodes_.size())).second) {
      throw std::invalid_argument(nameOf(NodeId(node.id)) + " is not the first of its number");
    }
    nodes_.push_back(std::move(node));
    if (id >= next_id_) next_id_ = id + 1;
  }

  bool contains(NodeIdType id) const {
    const auto found = slots_.find(id.value);
    return found != slots_.end() && found->second != kErased;
  }

  /// @throws std::out_of_range if it is not in the graph.
  uint32_t slot(NodeIdType id) const {
    const auto found = slots_.find(id.value);
    if (found == slots_.end() || found->second == kErased) {
      throw std::out_of_range(nameOf(NodeId(id)) + " is not in the graph");
    }
    return found->second;
  }

  /// Those above it move down by one place.
  void erase(uint32_t slot) {
    slots_[nodes_[slot].id.value] = kErased;
    nodes_.erase(slot);
    for (uint32_t k = slot; k < nodes_.size(); ++k) slots_[nodes_[k].id.value] = k;
  }

  template <typename Archive>
  void archive(Archive& a) {
    a("nodes", nodes_);
    a("slots", slots_);
    a("next_id", next_id_);
  }

 private:
  static constexpr uint32_t kErased = std::numeric_limits<uint32_t>::max();

  SharedVector<Node> nodes_;
  std::unordered_map<uint64_t, uint32_t> slots_;  ///< By id; kErased where there was one.
  uint64_t next_id_ = 0;
};

}  // namespace mrpt_sgraphs
