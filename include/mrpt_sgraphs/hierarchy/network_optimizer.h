// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <set>

#include "mrpt_sgraphs/graph/mrpt_network.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// What the information matrices of a network's edges are taken for.
enum class MrptInformation {
  /// What a CPose3DPDFGaussianInf means: x y z yaw pitch roll, converted at the edge's mean.
  kYawPitchRoll,
  /// The same as if the mean were near identity: yaw and roll exchanged, nothing else. What a g2o
  /// file had in it that MRPT has read.
  kPermuted,
  /// As it stands for `[t; theta]`: what MRPT's optimizer makes of it, yaw taken for roll.
  kTangent,
};

/// The sum over all edges of e' Omega e, e being the residual of relative_pose.h.
/// @throws std::invalid_argument as optimizeNetwork
double networkCost(const MrptNetwork& network,
                   MrptInformation meaning = MrptInformation::kYawPitchRoll);

/// Optimizes a network of poses in place: `optimize_graph_spa_levmarq` for those who want its
/// minimum (test/mrpt shows where that one stops short).
///
/// @param nodes_to_optimize  As MRPT has it: the others stay, to the last bit; all but the root
///                           where null. Edges between nodes that stay are left out of the
///                           report's costs.
/// @throws std::invalid_argument naming what is wrong with the network (see faultOf), an edge whose
///         information is not positive semidefinite, or a node to optimize that is not there.
OptimizerReport optimizeNetwork(const OptimizerConfig& config, MrptNetwork* network,
                                const std::set<mrpt::graphs::TNodeID>* nodes_to_optimize = nullptr,
                                MrptInformation meaning = MrptInformation::kYawPitchRoll);

}  // namespace mrpt_sgraphs
