// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

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

/// Whether the newest keyframe of a graph is in another one, of the same odometry: the other one is
/// what became of it.
bool goesOnFrom(const GraphSnapshot& later, const GraphSnapshot& earlier);

/// The keyframes of a graph that came after a stamp, as the front end gave them. Those without a cloud
/// are left out.
std::vector<Keyframe> keyframesAfter(double stamp_s, const GraphSnapshot& graph);

}  // namespace mrpt_sgraphs
