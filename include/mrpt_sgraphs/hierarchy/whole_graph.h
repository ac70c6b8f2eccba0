// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// What the hierarchy did with a graph that was there all at once. Times are CPU [ms].
struct WholeGraphReport {
  /// Iterations and times of the global optimizations; costs are those of the full graph.
  OptimizerReport global;
  int rounds = 0;  ///< Of condensing, global and resolving.
  double plan_ms = 0.0;
  double room_local_ms = 0.0;
  double condense_ms = 0.0;      ///< All rounds, with taking the keyframes out of the graph.
  double global_ms = 0.0;        ///< All rounds, with making the problem.
  double first_global_ms = 0.0;  ///< Of the first round alone.
  double resolve_ms = 0.0;
  std::vector<double> visit_ms;  ///< To condense each stay in a room.
  std::size_t dropped = 0;       ///< Keyframes.
  std::size_t active = 0;        ///< Keyframes that are left.
  std::size_t condensed = 0;     ///< Condensed factors, or the paper's bridges.
  double condensed_cost = 0.0;   ///< Of the graph that is left, at its optimum.
};

/// The hierarchy's stages on a graph that is there all at once, as one from a file: room-local
/// optimization and compression of every region, then the global optimization of what is left, from
/// the values that it had, then the dropped keyframes. In mode `condensed` all but the first again
/// from where that ended, as condensed factors hold to second order only and files begin far off:
/// until the cost of the full graph is what the condensed one says.
///
/// Dropped keyframes and their factors are then as in a run: marginalized and on the shelf.
/// @param mode   `condensed` or `paper`, which ends after one round: what it drops is lost.
/// @param graph  Nothing in it is dropped yet.
/// @throws std::invalid_argument for another mode.
WholeGraphReport optimizeWholeGraph(const std::string& mode, const OptimizerConfig& config,
                                    LayeredGraph* graph);

}  // namespace mrpt_sgraphs
