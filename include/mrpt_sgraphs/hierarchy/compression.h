// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/hierarchy/followers.h"
#include "mrpt_sgraphs/hierarchy/regions.h"

namespace mrpt_sgraphs {

/// Keeps a graph as small as what it has explored: keyframes of a region are dropped, and what they
/// knew stays as one factor.
class Compression {
 public:
  explicit Compression(const HierarchyConfig& config) : config_(config) {}

  const Followers& followers() const { return followers_; }
  Followers& followers() { return followers_; }

  /// What can be compressed now. Keyframes of the local window are left alone, and looking costs
  /// nothing until enough keyframes have come.
  /// @param changed  Also then, as rooms have changed.
  std::vector<RegionPlan> due(const LayeredGraph& graph, bool changed);

  /// Drops the keyframes of a plan, in mode `condensed` by the exact Schur complement of their
  /// factors where the graph is now, in mode `paper` as Sec. III-B has it.
  void apply(const RegionPlan& plan, LayeredGraph* graph);

  /// To be called before an optimization: condensed factors of which a part was erased, or that got
  /// one more, are made again from what is on the shelf.
  /// @return Whether there were any.
  bool mend(LayeredGraph* graph);

  /// Regions that a global optimization has bent: their dropped keyframes are found again.
  /// @return CPU time [ms].
  double resolve(const OptimizerConfig& optimizer, LayeredGraph* graph);

  /// Condenses the dropped keyframes of a kept one once more, where the graph is now: to do after they
  /// were found again far from where they were condensed.
  /// @return Whether they are determined; otherwise nothing has changed.
  bool condenseAgain(KeyframeId kept, LayeredGraph* graph);

  /// Everything that was dropped comes back, with the factors that it had.
  void restore(LayeredGraph* graph);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("active", active_);
    a("known", known_);
    a("looked_at", looked_at_);
    a("followers", followers_);
  }

 private:
  void takeIn(const LayeredGraph& graph);
  KeyframeId standIn(KeyframeId id, const std::vector<KeyframeId>& stay,
                     const LayeredGraph& graph) const;
  bool condenseRegion(const RegionPlan& plan, LayeredGraph* graph);
  void drop(const RegionPlan& plan, LayeredGraph* graph);
  bool makeAgain(KeyframeId kept, LayeredGraph* graph);

  const HierarchyConfig config_;
  std::vector<KeyframeId> active_;  ///< In the order in which they came.
  uint32_t known_ = 0;              ///< Places of keyframes below are in it or dropped.
  uint32_t looked_at_ = 0;          ///< How many keyframes there were when a plan was made.
  Followers followers_;
};

/// Sec. III-B to the letter. Keyframes and their observations are taken out; the neighbours that
/// remain are joined where they are closest, by an edge whose measurement is the relative pose now
/// and whose information is the sum of those of the edges that are gone. Of more than two neighbours
/// the closest pairs are joined that leave none alone (their minimum spanning tree; of equal
/// distances the pair of smaller ids).
/// @param kept  Under which the factors are shelved.
void marginalizeByTheLetter(KeyframeId kept, const std::vector<KeyframeId>& dropped,
                            LayeredGraph* graph);

}  // namespace mrpt_sgraphs
