// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/geometry/ids.h"

namespace mrpt_sgraphs {

/// Where a node is: its place in its layer. Good until a node of the layer is erased.
struct NodeHandle {
  Layer layer = Layer::kKeyframe;
  uint32_t slot = 0;

  friend bool operator==(NodeHandle a, NodeHandle b) {
    return a.layer == b.layer && a.slot == b.slot;
  }
};

/// A factor as one of its nodes sees it.
struct FactorLink {
  FactorId id;
  uint32_t slot = 0;  ///< The factor's place. Good until a factor is erased.
  uint32_t end = 0;   ///< Which of the factor's nodes this one is.
};

/// A node as one of its factors sees it.
struct FactorEnd {
  NodeHandle node;
  uint32_t position = 0;  ///< Of the factor among the node's sightings or others.
};

/// Which factors join which nodes, both ways: no search and no hashing to go from one to the other,
/// or to erase.
class Topology {
 public:
  using Links = std::vector<FactorLink>;
  using Ends = boost::container::small_vector<FactorEnd, 3>;

  /// The factors of a node. A corridor's wall is seen by thousands of keyframes and tied to few other
  /// nodes: sightings, factors between a keyframe and one surface, are kept apart from the others.
  const Links& sightings(NodeHandle node) const { return layerOf(node)[node.slot].sightings; }
  const Links& others(NodeHandle node) const { return layerOf(node)[node.slot].others; }
  std::size_t linkCount(NodeHandle node) const {
    return sightings(node).size() + others(node).size();
  }

  const Ends& ends(uint32_t factor) const { return ends_[factor]; }

  /// A node without factors, in the last place of its layer.
  void addNode(Layer layer) { links_[static_cast<std::size_t>(layer)].emplace_back(); }

  /// A node that has no factors any more. Those above it move down by one place.
  void eraseNode(NodeHandle node);

  /// A factor in the last place.
  /// @param nodes  All different.
  void addFactor(FactorId id, const std::vector<NodeHandle>& nodes);

  /// The last factor moves into its place.
  void eraseFactor(uint32_t factor);

  template <typename Archive>
  void archive(Archive& a) {
    a("links", links_);
    a("ends", ends_);
  }

 private:
  struct NodeLinks {
    Links sightings;
    Links others;

    template <typename Archive>
    void archive(Archive& a) {
      a("sightings", sightings);
      a("others", others);
    }
  };

  static bool isSighting(const Ends& ends);
  Links& linksOf(const FactorEnd& end, const Ends& ends) {
    NodeLinks& links = layerOf(end.node)[end.node.slot];
    return isSighting(ends) ? links.sightings : links.others;
  }
  std::vector<NodeLinks>& layerOf(NodeHandle node) {
    return links_[static_cast<std::size_t>(node.layer)];
  }
  const std::vector<NodeLinks>& layerOf(NodeHandle node) const {
    return links_[static_cast<std::size_t>(node.layer)];
  }

  std::array<std::vector<NodeLinks>, 4> links_;  ///< Layer, slot.
  std::vector<Ends> ends_;
};

}  // namespace mrpt_sgraphs
