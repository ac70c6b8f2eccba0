// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/io/state_files.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

/// The part `graph` of a saved state: the graph with all that its layers know, and the log of the
/// run.
void writeGraphState(GraphSlam* graph_slam, RunLog* log, StateWriter* state);

/// Into new ones.
/// @throws std::runtime_error as StateReader does.
void readGraphState(const StateReader& state, GraphSlam* graph_slam, RunLog* log);

}  // namespace mrpt_sgraphs
