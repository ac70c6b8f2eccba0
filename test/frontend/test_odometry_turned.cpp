// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "mrpt_sgraphs/frontend/odometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

struct TurnedBuilding {
  double turn_deg;
  double duration_s;  ///< Of the walk: up to where height was lost once.
};

void PrintTo(const TurnedBuilding& building, std::ostream* out) {
  *out << building.turn_deg << " degrees";
}

/// How a building lies to the cubic cells of the odometry's map is chance: what a cell cuts out of
/// walls and floor hangs on it, the robot's pose must not.
class OdometryInATurnedBuilding : public ::testing::TestWithParam<TurnedBuilding> {};

TEST_P(OdometryInATurnedBuilding, LosesNoHeight) {
  const test::SimulatedRun run =
      test::simulatedRun(sim::test::shipped("small"), "vlp16", GetParam().duration_s,
                         GetParam().turn_deg * M_PI / 180.0);
  Odometry odometry{OdometryConfig{}};
  Pose T_map_odom = Pose::Identity();
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    const auto result = odometry.process(*run.cloud(k));
    ASSERT_TRUE(result && result->registered) << "scan " << k;
    const Pose& T_map_base = run.truth[k].T_world_body;
    if (k == 0) T_map_odom = T_map_base * result->T_odom_base.inverse();
    const Pose T_truth_run = T_map_base.inverse() * T_map_odom * result->T_odom_base;
    // a single scan may be off: the floor is seen by few beams, and in a part of the sweep
    ASSERT_LT(T_truth_run.translation().norm(), 0.08) << "scan " << k;
    ASSERT_LT(logSO3(T_truth_run.linear()).norm(), 0.03) << "scan " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Turns, OdometryInATurnedBuilding,
                         ::testing::Values(TurnedBuilding{0.0, 15.0}, TurnedBuilding{17.0, 15.0},
                                           TurnedBuilding{40.0, 15.0}, TurnedBuilding{107.0, 20.0},
                                           TurnedBuilding{135.0, 7.0}, TurnedBuilding{165.0, 7.0}));

}  // namespace
}  // namespace mrpt_sgraphs
