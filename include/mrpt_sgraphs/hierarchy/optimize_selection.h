// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <vector>

#include "mrpt_sgraphs/hierarchy/selection.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// Optimizes the free nodes of a selection in the graph, under all factors that touch them. Nothing
/// else changes, not by one bit.
///
/// @throws std::out_of_range for a node that is not in the graph, std::invalid_argument naming the
///         nodes for one that is there twice, or for a factor to a node outside of the selection
///         unless that says to leave it out. The graph is then as it was.
OptimizerReport optimizeSelection(const Selection& selection, const OptimizerConfig& config,
                                  Optimizer* optimizer, LayeredGraph* graph);

/// Optimizes the nodes of these factors alone that `is_free` says may move. Nothing else changes.
/// @param factors  In the graph, on its shelf, or neither.
OptimizerReport optimizeUnder(const std::vector<FactorConstPtr>& factors,
                              const std::function<bool(NodeId)>& is_free,
                              const OptimizerConfig& config, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
