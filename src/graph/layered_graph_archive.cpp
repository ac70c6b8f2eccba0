// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/archive_graph.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

template <typename Archive>
void LayeredGraph::archive(Archive& a) {
  if constexpr (!Archive::kReads) writeMovedPoses();
  a("keyframes", keyframes_);
  a("walls", walls_);
  a("rooms", rooms_);
  a("floors", floors_);
  a("factors", factors_);
  a("topology", topology_);
  a("shelf", shelf_);
  a("broken_shelves", broken_shelves_);
  a("next_factor", next_factor_);
  a("erasures", erasures_);
  a("losses", losses_);
  a("T_map_odom", T_map_odom_);
  if constexpr (Archive::kReads) {
    // what can be made again of the rest
    for (const KeyframeNode& keyframe : keyframes_.nodes()) {
      network_.addNode(keyframe.id, keyframe.T_map_base);
    }
    is_moved_.assign(keyframes_.size(), false);
    for (const StoredFactor& stored : factors_) {
      const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
      edges_.emplace_back();
      if (edge != nullptr) edges_.back() = network_.addEdge(*edge);
      const auto slot = static_cast<uint32_t>(factor_slots_.size());
      factor_slots_[stored.id] = slot;
    }
    snapshot_.reset();
  }
}

template void LayeredGraph::archive(ArchiveWriter&);
template void LayeredGraph::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
