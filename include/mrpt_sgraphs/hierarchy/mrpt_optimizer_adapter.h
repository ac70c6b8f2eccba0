// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

// Slow to compile, and in a library of its own: link mrpt_sgraphs_mrpt_optimizer.
#include <mrpt/graphslam/interfaces/CGraphSlamOptimizer.h>

#include <set>
#include <string>

#include "mrpt_sgraphs/hierarchy/network_optimizer.h"

namespace mrpt_sgraphs {

/// Our solver behind MRPT's interface of optimizers, for callers that hold a network of poses and
/// no CGraphSlamEngine (which overwrites optimized poses by its own, test/mrpt).
///
/// As CLevMarqGSO, updateState() optimizes when the network has new nodes: all of it after a loop
/// closure, else what is near its last node. Ids need not be consecutive.
class MrptOptimizerAdapter final
    : public mrpt::graphslam::optimizers::CGraphSlamOptimizer<MrptNetwork> {
 public:
  /// What loadParams() reads; names as in an .ini for CLevMarqGSO where it has the same.
  struct Params {
    OptimizerConfig optimizer;
    MrptInformation information = MrptInformation::kYawPitchRoll;
    /// Nodes farther from the last one stay [m]; always the whole network if negative.
    double optimization_distance = -1.0;
    /// An edge between ids that differ by more closes a loop.
    int LC_min_nodeid_diff = 30;
  };

  MrptOptimizerAdapter();

  /// Reads from the sections that CLevMarqGSO reads from: `[OptimizerParameters]` the fields of
  /// OptimizerConfig, `optimization_distance` and `information` (yaw_pitch_roll, permuted or
  /// tangent), `[GeneralConfiguration]` `LC_min_nodeid_diff`. What is not given keeps its value;
  /// other keys are those of others.
  /// @throws std::invalid_argument naming the file, or key, value and range. Nothing is changed
  ///         then.
  void loadParams(const std::string& source_fname) override;
  void printParams() const override;

  /// @return  Whether the network is optimal now, or had nothing new. The caller holds the lock of
  ///          the network, as for all of MRPT's optimizers; what was measured is not looked at.
  /// @throws  as optimizeGraph
  bool updateState(mrpt::obs::CActionCollection::Ptr action,
                   mrpt::obs::CSensoryFrame::Ptr observations,
                   mrpt::obs::CObservation::Ptr observation) override;

  /// Optimizes the whole network, under the lock of setCriticalSectionPtr() if there is one.
  /// @throws std::logic_error without setGraphPtr(), std::invalid_argument as optimizeNetwork
  void optimizeGraph() override;

  bool justFullyOptimizedGraph() const override { return just_fully_optimized_; }
  void getDescriptiveReport(std::string* report_str) const override;

  const OptimizerReport& report() const { return report_; }  ///< Of the last optimization.

  Params params;

 private:
  void requireGraph() const;
  bool hasNewLoopClosure();
  std::set<mrpt::graphs::TNodeID> nodesNearTheLast() const;
  void optimize(const std::set<mrpt::graphs::TNodeID>* nodes);

  std::size_t known_nodes_ = 0;
  std::set<mrpt::graphs::TPairNodeIDs> known_edges_;
  bool just_fully_optimized_ = false;
  int optimizations_ = 0;
  OptimizerReport report_;
};

}  // namespace mrpt_sgraphs
