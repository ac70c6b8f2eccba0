// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <vector>

#include "mrpt_sgraphs/hierarchy/selection.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// The dropped keyframes, each by the kept one that it moves with.
///
/// They are moved when that has gone by more than a millimetre, or all at once on request: so that an
/// optimization does not cost more the more keyframes were dropped.
class Followers {
 public:
  /// @param T_map_kept  Where the kept one is as long as they are.
  void add(KeyframeId kept, const Pose& T_map_kept, KeyframeId dropped);
  /// Those of a kept keyframe that is dropped itself.
  std::vector<KeyframeId> take(KeyframeId kept);
  std::size_t count() const { return count_; }
  void clear();

  /// optimizeSelection, and dropped keyframes go with the kept ones, rigidly.
  OptimizerReport optimize(const Selection& selection, const OptimizerConfig& config,
                           Optimizer* optimizer, LayeredGraph* graph);

  /// Moves those of one kept keyframe, or all, to the last digit.
  void place(KeyframeId kept, LayeredGraph* graph);
  void placeAll(LayeredGraph* graph);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("of", of_);
    a("count", count_);
  }

 private:
  struct Group {
    std::vector<KeyframeId> dropped;
    Pose T_map_kept = Pose::Identity();  ///< When they were placed.

    template <typename Archive>
    void archive(Archive& a) {
      a("dropped", dropped);
      a("T_map_kept", T_map_kept);
    }
  };

  static void place(KeyframeId kept, Group* group, LayeredGraph* graph);

  std::map<KeyframeId, Group> of_;
  std::size_t count_ = 0;
};

/// Finds the dropped keyframes of a region again from their own factors, all that remains as it is:
/// where a loop has bent the region, they do not just move with one of its keyframes.
/// @param kept  Whose condensed factor the keyframes are in.
/// @return CPU time [ms].
double resolveDropped(KeyframeId kept, const OptimizerConfig& config, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
