// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_state.h"

namespace mrpt_sgraphs {

void writeGraphState(GraphSlam* graph_slam, RunLog* log, StateWriter* state) {
  state->add("graph", [&](auto& a) {
    a("graph_slam", *graph_slam);
    a("log", *log);
  });
}

void readGraphState(const StateReader& state, GraphSlam* graph_slam, RunLog* log) {
  state.read("graph", [&](auto& a) {
    a("graph_slam", *graph_slam);
    a("log", *log);
  });
}

}  // namespace mrpt_sgraphs
