// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "mrpt_sgraphs/graph/mrpt_network.h"

namespace mrpt_sgraphs::test {

/// What MRPT's optimizer did.
struct LevmarqResult {
  double final_total_sq_error = 0.0;  ///< As it reports it.
  std::string log;                    ///< What it printed, being verbose.
};

/// mrpt::graphslam::optimize_graph_spa_levmarq
LevmarqResult optimizeWithMrpt(MrptNetwork* network, int max_iterations = 100);

/// The nodes that mrpt::graphslam::optimizers::CLevMarqGSO would optimize around one of them.
std::set<mrpt::graphs::TNodeID> nodesNearByMrpt(MrptNetwork* network, mrpt::graphs::TNodeID around,
                                                double distance_m);

}  // namespace mrpt_sgraphs::test
