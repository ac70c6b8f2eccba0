// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "mrpt_sgraphs/graph/topology.h"

namespace mrpt_sgraphs {

/// Nodes in the order in which they were added, each once.
class NodeSet {
 public:
  /// @return Whether it was not there before.
  bool add(NodeHandle node) {
    if (!seen_.insert(key(node)).second) return false;
    nodes_.push_back(node);
    return true;
  }
  bool contains(NodeHandle node) const { return seen_.count(key(node)) != 0; }
  const std::vector<NodeHandle>& nodes() const { return nodes_; }

 private:
  static uint64_t key(NodeHandle node) {
    return (static_cast<uint64_t>(node.layer) << 32U) | node.slot;
  }

  std::unordered_set<uint64_t> seen_;
  std::vector<NodeHandle> nodes_;
};

}  // namespace mrpt_sgraphs
