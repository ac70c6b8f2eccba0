// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/solver/pose_graph_optimizer.h"

#include <gtest/gtest.h>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

/// A robot's two rounds of a square of 20 m, exact edges, loops between the rounds.
struct Rounds {
  Rounds() {
    constexpr int kSteps = 40;
    for (int i = 0; i < 2 * kSteps; ++i) {
      const double turn = 2.0 * M_PI * i / kSteps;
      Pose T = Pose::Identity();
      T.translation() << 10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.02 * i;
      T.linear() = expSO3({0.0, 0.0, turn + M_PI_2});
      truth[KeyframeId{static_cast<uint64_t>(i)}] = T;
      if (i > 0) connect(i - 1, i, RelativePoseEdge::Kind::kOdometry);
      if (i >= kSteps && i % 4 == 0) connect(i - kSteps, i, RelativePoseEdge::Kind::kLoopClosure);
    }
  }
  void connect(int from, int to, RelativePoseEdge::Kind kind) {
    RelativePoseEdge edge;
    edge.from = KeyframeId{static_cast<uint64_t>(from)};
    edge.to = KeyframeId{static_cast<uint64_t>(to)};
    edge.T_from_to = truth.at(edge.from).inverse() * truth.at(edge.to);
    edge.information.diagonal() << Eigen::Vector3d::Constant(1e4), Eigen::Vector3d::Constant(1e5);
    edge.kind = kind;
    edges.push_back(edge);
  }
  /// Every pose but the first moved.
  std::map<KeyframeId, Pose> disturbed(double limit_m, double limit_rad) const {
    test::RandomGeometry random(9);
    std::map<KeyframeId, Pose> poses = truth;
    for (auto& [id, T] : poses) {
      if (id != poses.begin()->first) T = T * random.smallPose(limit_m, limit_rad);
    }
    return poses;
  }
  double worst(const std::map<KeyframeId, Pose>& poses) const {
    double worst_m = 0.0;
    for (const auto& [id, T] : poses) {
      worst_m = std::max(worst_m, (T.translation() - truth.at(id).translation()).norm());
    }
    return worst_m;
  }

  std::map<KeyframeId, Pose> truth;
  std::vector<RelativePoseEdge> edges;
};

TEST(PoseGraphOptimizer, FindsTheTruthThatTheEdgesAgreeOn) {
  const Rounds rounds;
  auto poses = rounds.disturbed(0.3, 0.1);
  const OptimizationSummary summary = optimizePoseGraph(rounds.edges, {}, &poses);
  EXPECT_TRUE(summary.converged) << summary.problem;
  EXPECT_GT(summary.cost_before, 1.0);
  EXPECT_NEAR(summary.cost_after, 0.0, 1e-6);
  EXPECT_LT(rounds.worst(poses), 1e-5);
  EXPECT_EQ(summary.free_variables, 6 * 79);
}

TEST(PoseGraphOptimizer, DoesNotMoveTheFirstPoseByOneBit) {
  const Rounds rounds;
  auto poses = rounds.disturbed(0.3, 0.1);
  optimizePoseGraph(rounds.edges, {}, &poses);
  EXPECT_EQ(poses.begin()->second.matrix(), rounds.truth.begin()->second.matrix());
}

TEST(PoseGraphOptimizer, DoesNotDependOnWhereTheMapOriginIs) {
  const Rounds rounds;
  auto poses = rounds.disturbed(0.1, 0.05);
  const Pose T_other_map = test::RandomGeometry(4, 100.0).pose();
  auto moved = poses;
  for (auto& [id, T] : moved) T = T_other_map * T;
  optimizePoseGraph(rounds.edges, {}, &poses);
  optimizePoseGraph(rounds.edges, {}, &moved);
  for (const auto& [id, T] : poses) {
    EXPECT_NEAR((moved.at(id).matrix() - (T_other_map * T).matrix()).norm(), 0.0, 1e-6);
  }
}

TEST(PoseGraphOptimizer, OneFalseLoopDoesNotBendTheMap) {
  Rounds rounds;
  rounds.connect(5, 60, RelativePoseEdge::Kind::kLoopClosure);
  rounds.edges.back().T_from_to.translation().x() += 4.0;
  auto poses = rounds.truth;
  const OptimizationSummary summary = optimizePoseGraph(rounds.edges, {}, &poses);
  EXPECT_TRUE(summary.converged) << summary.problem;
  EXPECT_LT(rounds.worst(poses), 0.02);
}

TEST(PoseGraphOptimizer, SaysWhenPartsAreNotConnected) {
  Rounds rounds;
  rounds.edges.erase(rounds.edges.begin() + 20, rounds.edges.end());  // poses 21 .. 79 hang free
  const auto before = rounds.disturbed(0.1, 0.05);
  auto poses = before;
  const OptimizationSummary summary = optimizePoseGraph(rounds.edges, {}, &poses);
  EXPECT_FALSE(summary.converged);
  EXPECT_FALSE(summary.problem.empty());
  for (const auto& [id, T] : poses) EXPECT_TRUE(T.matrix().allFinite()) << id.value;
}

TEST(PoseGraphOptimizer, HasNothingToDoForOnePoseOrNone) {
  std::map<KeyframeId, Pose> none;
  EXPECT_TRUE(optimizePoseGraph({}, {}, &none).converged);
  std::map<KeyframeId, Pose> one{{KeyframeId{3}, Pose::Identity()}};
  EXPECT_TRUE(optimizePoseGraph({}, {}, &one).converged);
}

}  // namespace
}  // namespace mrpt_sgraphs
