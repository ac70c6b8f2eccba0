// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using Kind = RelativePoseFactor::Kind;

constexpr uint64_t kSteps = 40;
constexpr uint64_t kKeyframes = 2 * kSteps;

/// Where a robot is on its two rounds of a circle of 20 m.
Pose truth(uint64_t k) {
  const double turn = 2.0 * M_PI * static_cast<double>(k) / kSteps;
  Pose T = Pose::Identity();
  T.translation() << 10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.02 * static_cast<double>(k);
  T.linear() = expSO3({0.0, 0.0, turn + M_PI_2});
  return T;
}

/// The graph of its rounds: exact edges, loops between the rounds, poses moved from the truth.
class Rounds {
 public:
  /// @param odometry_edges  From the first keyframe on.
  explicit Rounds(double limit_m = 0.0, double limit_rad = 0.0,
                  const Pose& T_other_map = Pose::Identity(),
                  uint64_t odometry_edges = kKeyframes) {
    test::RandomGeometry random(9);
    for (uint64_t k = 0; k < kKeyframes; ++k) {
      const Pose error = k == 0 ? Pose::Identity() : random.smallPose(limit_m, limit_rad);
      graph.addKeyframe(T_other_map * truth(k) * error, {});
      if (k > 0 && k <= odometry_edges) connect(k - 1, k, Kind::kOdometry);
      if (odometry_edges == kKeyframes && k >= kSteps && k % 4 == 0) {
        connect(k - kSteps, k, Kind::kLoopClosure);
      }
    }
  }

  void connect(uint64_t from, uint64_t to, Kind kind, const Pose& error = Pose::Identity()) {
    Matrix6 information = Matrix6::Identity();
    information.diagonal() << Eigen::Vector3d::Constant(1e4), Eigen::Vector3d::Constant(1e5);
    RobustKernel kernel;
    if (kind == Kind::kLoopClosure) kernel = {RobustKernel::Kind::kCauchy, 12.6};
    graph.addFactor(std::make_shared<RelativePoseFactor>(KeyframeId{from}, KeyframeId{to},
                                                         error * truth(from).inverse() * truth(to),
                                                         information, kind, kernel));
  }

  OptimizerReport optimize() {
    Optimizer optimizer;
    return optimizeSelection(selectAll(graph), {}, &optimizer, &graph);
  }

  double worst_m() const {
    double worst = 0.0;
    for (uint64_t k = 0; k < kKeyframes; ++k) {
      const Eigen::Vector3d place = graph.pose(KeyframeId{k}).translation();
      worst = std::max(worst, (place - truth(k).translation()).norm());
    }
    return worst;
  }

  LayeredGraph graph;
};

TEST(OptimizeWholeGraph, FindsTheTruthThatTheEdgesAgreeOn) {
  Rounds rounds(0.3, 0.1);
  const OptimizerReport report = rounds.optimize();
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_TRUE(report.gauge.empty());
  EXPECT_GT(report.cost_before, 1.0);
  EXPECT_NEAR(report.cost_after, 0.0, 1e-6);
  EXPECT_LT(rounds.worst_m(), 1e-5);
  EXPECT_EQ(report.free_tangents, 6 * 79);
}

TEST(OptimizeWholeGraph, DoesNotMoveTheFirstPoseByOneBit) {
  Rounds rounds(0.3, 0.1);
  rounds.optimize();
  EXPECT_EQ(rounds.graph.pose(KeyframeId{0}).matrix(), truth(0).matrix());
}

TEST(OptimizeWholeGraph, DoesNotDependOnWhereTheMapOriginIs) {
  const Pose T_other_map = test::RandomGeometry(4, 100.0).pose();
  Rounds rounds(0.1, 0.05);
  Rounds moved(0.1, 0.05, T_other_map);
  rounds.optimize();
  moved.optimize();
  for (uint64_t k = 0; k < kKeyframes; ++k) {
    const Pose expected = T_other_map * rounds.graph.pose(KeyframeId{k});
    EXPECT_NEAR((moved.graph.pose(KeyframeId{k}).matrix() - expected.matrix()).norm(), 0.0, 1e-6);
  }
}

TEST(OptimizeWholeGraph, OneFalseLoopDoesNotBendTheMap) {
  Rounds rounds;
  rounds.connect(5, 60, Kind::kLoopClosure, Pose(Eigen::Translation3d(4.0, 0.0, 0.0)));
  const OptimizerReport report = rounds.optimize();
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_LT(rounds.worst_m(), 0.02);
}

TEST(OptimizeWholeGraph, NamesPartsThatNothingHolds) {
  Rounds rounds(0.1, 0.05, Pose::Identity(), 20);  // keyframes 21 .. 79 hang free
  rounds.connect(30, 31, Kind::kOdometry, Pose::Identity());
  const OptimizerReport report = rounds.optimize();
  // those that nothing is known of take no part
  ASSERT_EQ(report.gauge.size(), 1U);
  EXPECT_EQ(report.gauge[0].dimensions, 6);
  EXPECT_EQ(report.gauge[0].nodes, (std::vector<NodeId>{KeyframeId{30}, KeyframeId{31}}));
  for (uint64_t k = 0; k < kKeyframes; ++k) {
    EXPECT_TRUE(rounds.graph.pose(KeyframeId{k}).matrix().allFinite()) << k;
  }
}

TEST(OptimizeWholeGraph, HasNothingToDoForOneKeyframe) {
  LayeredGraph graph;
  graph.addKeyframe(Pose::Identity(), {});
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection(selectAll(graph), {}, &optimizer, &graph).converged);
}

}  // namespace
}  // namespace mrpt_sgraphs
