// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_set>

#include "shown_graph.h"

namespace mrpt_sgraphs {

/// What a node's colour says.
enum class ColourBy : std::uint8_t {
  kLayer,  ///< Which layer it is of; of a keyframe, whether it is dropped.
  kRoom,   ///< In which room it is.
  kFloor,  ///< On which floor.
  kAge,    ///< When the robot was there first: from blue to yellow.
};

/// The colours of one graph's nodes.
class GraphPalette {
 public:
  GraphPalette(const ShownGraph& graph, ColourBy by);

  /// Red, green and blue from 0 to 1; grey for a node of which it is not known.
  Eigen::Vector3f of(NodeId node) const;

 private:
  Eigen::Vector3f byLayer(NodeId node) const;
  Eigen::Vector3f byAge(NodeId node) const;

  const ShownGraph& graph_;
  const ColourBy by_;
  std::unordered_set<NodeId> dropped_;
  double oldest_s_ = 0.0;
  double newest_s_ = 0.0;
};

}  // namespace mrpt_sgraphs
