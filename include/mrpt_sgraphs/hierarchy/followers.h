// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <vector>

#include "mrpt_sgraphs/hierarchy/selection.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// The dropped keyframes, each by the kept one that it moves with.
class Followers {
 public:
  void add(KeyframeId kept, KeyframeId dropped) { of_[kept].push_back(dropped); }
  /// Those of a kept keyframe that is dropped itself.
  std::vector<KeyframeId> take(KeyframeId kept);
  std::size_t count() const;
  void clear() { of_.clear(); }

  /// optimizeSelection, and dropped keyframes go with the kept ones, rigidly.
  OptimizerReport optimize(const Selection& selection, const OptimizerConfig& config,
                           Optimizer* optimizer, LayeredGraph* graph) const;

 private:
  std::map<KeyframeId, std::vector<KeyframeId>> of_;
};

/// Finds the dropped keyframes of a region again from their own factors, all that remains as it is:
/// where a loop has bent the region, they do not just move with one of its keyframes.
/// @param kept  Whose condensed factor the keyframes are in.
/// @return CPU time [ms].
double resolveDropped(KeyframeId kept, const OptimizerConfig& config, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
