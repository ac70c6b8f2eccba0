// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <new>

#include "mrpt_sgraphs/solver/optimizer.h"
#include "support/small_problem.h"

namespace mrpt_sgraphs {
namespace {

using test::SmallWorld;

constexpr OptimizerConfig kDefaults{};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool allFinite(const Problem& problem) {
  for (const Pose& T : problem.values().poses) {
    if (!T.matrix().allFinite()) return false;
  }
  for (const Plane& plane : problem.values().planes) {
    if (!plane.normal.allFinite() || !std::isfinite(plane.distance)) return false;
  }
  return true;
}

std::unique_ptr<RelativePoseFactor> edge(uint64_t from, uint64_t to, const Matrix6& information) {
  return std::make_unique<RelativePoseFactor>(KeyframeId{from}, KeyframeId{to}, Pose::Identity(),
                                              information);
}

/// Ties two keyframes to each other until there is no memory.
class ExhaustedFactor final : public Factor {
 public:
  ExhaustedFactor(KeyframeId from, KeyframeId to) : nodes_{from, to} {}
  const char* type() const override { return "exhausted"; }
  int nodeCount() const override { return 2; }
  NodeId node(int index) const override { return nodes_[index]; }
  double cost(const VariableView*) const override { throw std::bad_alloc(); }
  double linearize(const VariableView*, double*, double*) const override { throw std::bad_alloc(); }

 private:
  NodeId nodes_[2];
};

TEST(OptimizerFaults, WantOfMemoryIsReportedFromEachThread) {
  for (const int threads : {1, 2}) {
    for (const int at : {1, 1000, 2900}) {  // one of them in a subtree of the other thread
      SmallWorld world(3000);
      world.add(std::make_unique<ExhaustedFactor>(KeyframeId{static_cast<uint64_t>(at)},
                                                  KeyframeId{static_cast<uint64_t>(at) + 1}),
                {at, at + 1});
      Problem problem = world.problem();
      const Problem before = problem;
      OptimizerConfig config;
      config.threads = threads;
      const OptimizerReport report = Optimizer().optimize(config, &problem);
      EXPECT_FALSE(report.converged);
      EXPECT_EQ(report.problem, std::bad_alloc().what());
      for (int v = 0; v < 3000; ++v) ASSERT_EQ(problem.pose(v).matrix(), before.pose(v).matrix());
    }
  }
}

TEST(OptimizerFaults, AnEmptyProblemAndASingleNodeHaveNothingToDo) {
  Problem empty;
  EXPECT_TRUE(Optimizer().optimize(kDefaults, &empty).converged);
  Problem fixed;
  fixed.addVariable(KeyframeId{3}, Pose::Identity(), true);
  EXPECT_TRUE(Optimizer().optimize(kDefaults, &fixed).converged);
  Problem free;
  free.addVariable(KeyframeId{3}, Pose::Identity());
  const OptimizerReport report = Optimizer().optimize(kDefaults, &free);
  EXPECT_TRUE(report.converged);
  ASSERT_EQ(report.gauge.size(), 1U);
  EXPECT_EQ(report.gauge.front().held, NodeId(KeyframeId{3}));
  EXPECT_FALSE(free.isFixed(0));
}

TEST(OptimizerFaults, WithoutAnythingFixedItHoldsTheFirstKeyframeAndSaysSo) {
  const SmallWorld world(50);
  Problem problem = world.problem(0.2, 0.05, false);
  const Pose first = problem.pose(0);
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  ASSERT_EQ(report.gauge.size(), 1U);
  EXPECT_EQ(report.gauge.front().held, NodeId(KeyframeId{0}));
  EXPECT_EQ(report.gauge.front().dimensions, 6);
  EXPECT_EQ(report.gauge.front().nodes.size(), 54U);
  EXPECT_EQ(problem.pose(0).matrix(), first.matrix());

  Problem held = world.problem(0.2, 0.05, true);
  EXPECT_NEAR(Optimizer().optimize(kDefaults, &held).cost_after, report.cost_after, 1e-9);
}

TEST(OptimizerFaults, EachUnconnectedPartIsNamed) {
  SmallWorld world(50);
  Problem problem = world.problem();
  const Matrix6 information = Matrix6::Identity() * 100.0;
  const auto tie = edge(100, 101, information);
  const int a = problem.addVariable(KeyframeId{100}, Pose::Identity());
  const int b = problem.addVariable(KeyframeId{101}, expPose(Tangent::Constant(0.3)));
  const int ends[2] = {a, b};
  problem.addFactor(*tie, ends);
  problem.addVariable(WallId{77}, Plane{});
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  ASSERT_EQ(report.gauge.size(), 2U);
  EXPECT_EQ(report.gauge[0].nodes, (std::vector<NodeId>{KeyframeId{100}, KeyframeId{101}}));
  EXPECT_EQ(report.gauge[1].nodes, (std::vector<NodeId>{WallId{77}}));
  EXPECT_LT((problem.pose(a).inverse() * problem.pose(b)).translation().norm(), 1e-6);
}

TEST(OptimizerFaults, NamesTheDirectionsThatFactorsLeaveFree) {
  // a keyframe that sees one wall only: it slides along the wall (2) and turns about its normal (1)
  SmallWorld world(20);
  Problem problem = world.problem();
  const int lonely = problem.addVariable(KeyframeId{500}, world.truth[3]);
  const PlaneObservationFactor seen(KeyframeId{500}, WallId{0},
                                    world.truth[3].inverse() * world.walls[0],
                                    Eigen::Matrix3d::Identity() * 1e4);
  const int ends[2] = {lonely, 20};
  problem.addFactor(seen, ends);
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_TRUE(report.converged) << report.problem;
  ASSERT_EQ(report.gauge.size(), 1U);
  EXPECT_EQ(report.gauge.front().dimensions, 3);
  EXPECT_EQ(report.gauge.front().nodes, (std::vector<NodeId>{KeyframeId{500}}));
  EXPECT_TRUE(allFinite(problem));
}

TEST(OptimizerFaults, AFactorThatIsNotANumberIsNamedAndNothingMoves) {
  SmallWorld world(30);
  Matrix6 information = Matrix6::Identity();
  information(2, 2) = kNaN;
  world.add(edge(4, 9, information), {4, 9});
  Problem problem = world.problem();
  const Problem before = problem;
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.problem.find("keyframe 4"), std::string::npos) << report.problem;
  EXPECT_NE(report.problem.find("keyframe 9"), std::string::npos) << report.problem;
  for (int v = 0; v < 30; ++v) EXPECT_EQ(problem.pose(v).matrix(), before.pose(v).matrix());
}

TEST(OptimizerFaults, IndefiniteInformationIsNamedAndTheCostDoesNotRise) {
  SmallWorld world(30);
  Matrix6 information = Matrix6::Zero();
  information(0, 0) = -1e7;
  world.add(edge(4, 9, information), {4, 9});
  Problem problem = world.problem();
  const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.problem.empty());
  EXPECT_TRUE(allFinite(problem));
  EXPECT_LE(report.cost_after, report.cost_before);
}

TEST(OptimizerFaults, HugeAndTinyInformationStayFinite) {
  for (const double scale : {1e-300, 1e-30, 1e30, 1e150, 1e300}) {
    SCOPED_TRACE(scale);
    SmallWorld world(30);
    world.add(edge(4, 9, Matrix6::Identity() * scale), {4, 9});
    Problem problem = world.problem();
    const OptimizerReport report = Optimizer().optimize(kDefaults, &problem);
    EXPECT_TRUE(allFinite(problem));
    EXPECT_TRUE(report.converged || !report.problem.empty());
    EXPECT_FALSE(report.cost_after > report.cost_before);
  }
}

TEST(OptimizerFaults, AProblemRefusesWhatItCannotHold) {
  Problem problem;
  Pose bad = Pose::Identity();
  bad.translation().x() = kNaN;
  EXPECT_THROW(problem.addVariable(KeyframeId{0}, bad), std::invalid_argument);
  EXPECT_THROW(problem.addVariable(KeyframeId{0}, Plane{}), std::invalid_argument);
  EXPECT_THROW(problem.addVariable(WallId{0}, Pose::Identity()), std::invalid_argument);
  const int keyframe = problem.addVariable(KeyframeId{0}, Pose::Identity());
  const int wall = problem.addVariable(WallId{0}, Plane{});
  const auto factor = edge(0, 1, Matrix6::Identity());
  for (const std::array<int, 2> ends : {std::array<int, 2>{keyframe, 7}, {keyframe, -1},
                                        {keyframe, wall}, {keyframe, keyframe}}) {
    EXPECT_THROW(problem.addFactor(*factor, ends.data()), std::invalid_argument);
  }
  EXPECT_EQ(problem.factorCount(), 0);
}

}  // namespace
}  // namespace mrpt_sgraphs
