// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <mrpt/graphs/CNetworkOfPoses.h>

#include <map>
#include <vector>

#include "mrpt_sgraphs/graph/mrpt_information.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The keyframes layer: an MRPT network of poses, and beside it what MRPT has no place for.
class KeyframeGraph {
 public:
  using Network = mrpt::graphs::CNetworkOfPoses3DInf;

  /// Gives the keyframe the next id; ids are never used twice.
  KeyframeId add(double stamp_s, const Pose& T_map_base, const Pose& T_odom_base,
                 const Cloud::ConstPtr& cloud);

  /// @throws std::invalid_argument if an end is not in the graph, or pose or information are not
  ///         finite.
  void add(const RelativePoseEdge& edge);

  /// Hands the poses, edges and ids to MRPT.
  const Network& network() const { return network_; }

  std::size_t size() const { return details_.size(); }
  std::size_t edgeCount() const { return edges_.size(); }

  /// @throws std::out_of_range for an id that is not in the graph; so do the others that take one.
  Pose pose(KeyframeId id) const;
  void setPose(KeyframeId id, const Pose& T_map_base);
  KeyframeNode node(KeyframeId id) const;

  /// In the order in which they were added.
  RelativePoseEdge edge(std::size_t index) const;

  std::vector<KeyframeId> ids() const;

 private:
  struct Details {
    double stamp_s;
    Pose T_odom_base;
    Cloud::ConstPtr cloud;
  };
  struct StoredEdge {
    RelativePoseEdge::Kind kind;
    Network::const_iterator in_network;  ///< Stable: MRPT's edges are a multimap.
  };

  Network network_;
  std::map<KeyframeId, Details> details_;
  std::vector<StoredEdge> edges_;
  uint64_t next_id_ = 0;
};

}  // namespace mrpt_sgraphs
