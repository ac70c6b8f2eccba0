// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "levmarq.h"

#include <gtest/gtest.h>
// CLevMarqGSO.h does not include all that it needs
// clang-format off
#include <mrpt/config/CConfigFile.h>
#include <mrpt/opengl/CDisk.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSphere.h>
#include <mrpt/system/CTicTac.h>
#include <mrpt/graphslam/GSO/CLevMarqGSO.h>
// clang-format on
#include <mrpt/graphslam/levmarq.h>

namespace mrpt_sgraphs::test {

LevmarqResult optimizeWithMrpt(MrptNetwork* network, int max_iterations) {
  mrpt::containers::yaml parameters;
  parameters["verbose"] = true;
  parameters["max_iterations"] = max_iterations;
  mrpt::graphslam::TResultInfoSpaLevMarq result{};
  testing::internal::CaptureStdout();
  mrpt::graphslam::optimize_graph_spa_levmarq(*network, result, nullptr, parameters);
  return {result.final_total_sq_error, testing::internal::GetCapturedStdout()};
}

std::set<mrpt::graphs::TNodeID> nodesNearByMrpt(MrptNetwork* network, mrpt::graphs::TNodeID around,
                                                double distance_m) {
  struct Opened : mrpt::graphslam::optimizers::CLevMarqGSO<MrptNetwork> {
    using CLevMarqGSO<MrptNetwork>::getNearbyNodesOf;
  };
  Opened optimizer;
  optimizer.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  optimizer.setGraphPtr(network);
  std::set<mrpt::graphs::TNodeID> nodes;
  optimizer.getNearbyNodesOf(&nodes, around, distance_m);
  return nodes;
}

}  // namespace mrpt_sgraphs::test
