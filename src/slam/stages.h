// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/hierarchy/compression.h"
#include "mrpt_sgraphs/hierarchy/local_window.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// The stages of Sec. III on one graph: what is optimized, and what is compressed then.
class Stages {
 public:
  using Summaries = std::vector<OptimizationSummary>;

  /// @throws std::invalid_argument for a mode that is none.
  Stages(const HierarchyConfig& hierarchy, const OptimizerConfig& optimizer);

  /// In mode baseline all of them are the whole graph.
  OptimizationSummary local(LayeredGraph* graph);
  OptimizationSummary room(RoomId room, LayeredGraph* graph);
  /// After a loop. Where its whole way lies on one of several storeys, that storey is enough.
  /// @param storey  None: the loop is not on one.
  OptimizationSummary global(const std::optional<FloorId>& storey, LayeredGraph* graph);

  /// Drops what is no longer needed one by one, each room after an optimization of its own.
  /// @param changed  Rooms have, so it may be more than what keyframes that came tell.
  void compress(bool changed, LayeredGraph* graph, Summaries* summaries);

  /// The whole graph to the last digit, and the dropped keyframes again within their regions.
  void finish(LayeredGraph* graph, Summaries* summaries);

  /// Everything that was dropped comes back.
  void restore(LayeredGraph* graph) { compression_.restore(graph); }

  bool compresses() const { return hierarchy_.mode != "baseline"; }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("window", window_);
    a("compression", compression_);
    a("optimized_room", optimized_room_);
    a("optimized_at", optimized_at_);
  }

 private:
  OptimizationSummary optimize(const char* kind, const Selection& selection,
                               double min_relative_decrease, LayeredGraph* graph);
  OptimizationSummary optimizeRoom(RoomId room, LayeredGraph* graph);
  OptimizationSummary condense(const RegionPlan& plan, LayeredGraph* graph);
  OptimizationSummary begun(const char* kind, const LayeredGraph& graph) const;

  const HierarchyConfig hierarchy_;
  OptimizerConfig optimizer_config_;
  Optimizer optimizer_;
  LocalWindow window_;
  Compression compression_;
  std::optional<RoomId> optimized_room_;  ///< The last one,
  std::size_t optimized_at_ = 0;          ///< and how many keyframes there were then.
};

}  // namespace mrpt_sgraphs
