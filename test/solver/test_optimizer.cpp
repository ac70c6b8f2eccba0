// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/solver/optimizer.h"

#include <gtest/gtest.h>

#include "support/small_problem.h"

namespace mrpt_sgraphs {
namespace {

using test::SmallWorld;

constexpr OptimizerConfig kDefaults{};

TEST(Optimizer, FindsTheTruthThatAllFactorsAgreeOn) {
  const SmallWorld world(80, 1, 0.0);
  Problem problem = world.problem();
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_TRUE(report.problem.empty()) << report.problem;
  EXPECT_GT(report.cost_before, 1.0);
  EXPECT_NEAR(report.cost_after, 0.0, 1e-6);
  EXPECT_LT(world.worstPosition_m(problem), 1e-6);
  EXPECT_EQ(report.free_tangents, 6 * 79 + 3 * 4);
  EXPECT_TRUE(report.gauge.empty());
  for (int w = 0; w < 4; ++w) {
    EXPECT_NEAR((problem.plane(80 + w).normal - world.walls[w].normal).norm(), 0.0, 1e-7);
    EXPECT_NEAR(problem.plane(80 + w).distance, world.walls[w].distance, 1e-6);
  }
}

TEST(Optimizer, EndsWhereNoSmallMoveIsBetter) {
  const SmallWorld world(60);
  Problem problem = world.problem();
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  ASSERT_TRUE(report.converged) << report.problem;
  EXPECT_NEAR(report.cost_after, problem.cost(), 1e-9 * report.cost_after);
  for (int v = 1; v < problem.variableCount(); ++v) {
    for (int t = 0; t < problem.tangentSizeOf(v); ++t) {
      for (const double step : {-1e-4, 1e-4}) {
        Problem moved = problem;
        double delta[6] = {};
        delta[t] = step;
        moved.retractVariable(v, delta);
        EXPECT_GE(moved.cost(), report.cost_after) << nameOf(problem.node(v)) << " along " << t;
      }
    }
  }
}

TEST(Optimizer, DoesNotMoveWhatIsFixedByOneBit) {
  const SmallWorld world(60);
  Problem problem = world.problem();
  for (int v = 0; v < problem.variableCount(); ++v) problem.setFixed(v, v % 3 == 0);
  const Problem before = problem;
  EXPECT_TRUE(Optimizer().optimize(kDefaults, &problem).converged);
  int moved = 0;
  for (int v = 0; v < problem.variableCount(); ++v) {
    const bool is_pose = v < 60;
    const bool same = is_pose ? problem.pose(v).matrix() == before.pose(v).matrix()
                              : problem.plane(v).normal == before.plane(v).normal &&
                                    problem.plane(v).distance == before.plane(v).distance;
    EXPECT_TRUE(same || v % 3 != 0) << nameOf(problem.node(v));
    moved += same ? 0 : 1;
  }
  EXPECT_GE(moved, 2 * 64 / 3 - 1);
}

TEST(Optimizer, DoesNotDependOnWhereTheMapOriginIs) {
  const SmallWorld world(60);
  const Pose T_other_map = test::RandomGeometry(4, 100.0).pose();
  Problem problem = world.problem(0.1, 0.05);
  Problem::Values values = problem.values();
  for (Pose& T : values.poses) T = T_other_map * T;
  for (Plane& plane : values.planes) plane = T_other_map * plane;
  Problem moved = problem;
  moved.setValues(values);
  const OptimizerReport here = Optimizer().optimize(kDefaults, &problem);
  const OptimizerReport there = Optimizer().optimize(kDefaults, &moved);
  EXPECT_NEAR(here.cost_after, there.cost_after, 1e-7 * here.cost_after);
  for (int v = 0; v < 60; ++v) {
    const Pose expected = T_other_map * problem.pose(v);
    EXPECT_NEAR((moved.pose(v).matrix() - expected.matrix()).norm(), 0.0, 1e-5);
  }
}

TEST(Optimizer, GivesTheSameBitsTwiceAndWithTwoThreads) {
  const SmallWorld world(3000);
  Problem once = world.problem();
  Problem again = world.problem();
  Problem shared = world.problem();
  OptimizerConfig two_threads;
  two_threads.threads = 2;
  Optimizer().optimize(kDefaults, &once);
  Optimizer().optimize(kDefaults, &again);
  Optimizer().optimize(two_threads, &shared);
  for (int v = 0; v < 3000; ++v) {
    ASSERT_EQ(once.pose(v).matrix(), again.pose(v).matrix());
    ASSERT_EQ(once.pose(v).matrix(), shared.pose(v).matrix());
  }
}

TEST(Optimizer, KeepsTheAnalysisWhileTheStructureStands) {
  const SmallWorld world(300);
  Optimizer optimizer;
  Problem problem = world.problem();
  EXPECT_GT(optimizer.optimize(kDefaults, &problem).analyze_ms, 0.0);
  Problem other_values = world.problem(0.05, 0.01);
  const OptimizerReport second = optimizer.optimize(kDefaults, &other_values);
  EXPECT_EQ(second.analyze_ms, 0.0);
  EXPECT_TRUE(second.converged);
  const SmallWorld larger(301);
  Problem other_structure = larger.problem();
  const OptimizerReport third = optimizer.optimize(kDefaults, &other_structure);
  EXPECT_GT(third.analyze_ms, 0.0);
  EXPECT_TRUE(third.converged);
}

TEST(Optimizer, StopsAtItsBudgetWithWhatItHas) {
  const SmallWorld world(400);
  OptimizerConfig config;
  config.max_iterations = 2;
  Problem problem = world.problem();
  const OptimizerReport report = Optimizer().optimize(config, &problem);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_EQ(report.problem, "stopped after 2 iterations");
  EXPECT_LE(report.cost_after, report.cost_before);
  EXPECT_NEAR(report.cost_after, problem.cost(), 1e-9 * report.cost_after);

  config = {};
  config.max_time_s = 1e-9;
  Problem other = world.problem();
  const OptimizerReport timed = Optimizer().optimize(config, &other);
  EXPECT_FALSE(timed.converged);
  EXPECT_EQ(timed.iterations, 0);
  EXPECT_NE(timed.problem.find("ms"), std::string::npos) << timed.problem;
}

TEST(Optimizer, ARobustKernelKeepsAFalseLoopFromBendingTheMap) {
  SmallWorld world(80, 1, 0.0);
  Pose wrong = world.truth[5].inverse() * world.truth[60];
  wrong.translation().x() += 4.0;
  Matrix6 information = Matrix6::Identity() * 1e4;
  world.add(std::make_unique<RelativePoseFactor>(
                KeyframeId{5}, KeyframeId{60}, wrong, information,
                RelativePoseFactor::Kind::kLoopClosure,
                RobustKernel{RobustKernel::Kind::kCauchy, 12.6}),
            {5, 60});
  Problem problem = world.problem(0.02, 0.01);
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_LT(world.worstPosition_m(problem), 0.02);
}

TEST(Optimizer, ComesHomeFromADriftThatBendsTheWholeWay) {
  // 600 keyframes whose odometry turns a little too much each step: the start is metres off
  const SmallWorld world(600, 1, 0.0);
  Problem problem = world.problem(0.0, 0.0);
  Problem::Values values = problem.values();
  const Pose drift = expPose((Tangent() << 0.003, 0.001, 0.001, 0.0003, 0.0002, 0.001).finished());
  for (std::size_t i = 1; i < values.poses.size(); ++i) {
    values.poses[i] = values.poses[i - 1] * world.truth[i - 1].inverse() * world.truth[i] * drift;
  }
  problem.setValues(values);
  ASSERT_GT(world.worstPosition_m(problem), 3.0);
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_LT(world.worstPosition_m(problem), 1e-4);
  EXPECT_LE(report.iterations, 15);
}

}  // namespace
}  // namespace mrpt_sgraphs
