// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "mrpt_sgraphs/slam/graph_slam.h"
#include "semantics/keyframes_of_a_walk.h"

namespace mrpt_sgraphs {
namespace {

using test::KeyframeWithTruth;

constexpr double kRadPerDeg = M_PI / 180.0;

/// How far the newest keyframe is from where it should be, seen from the first.
double finalError(const GraphSnapshot& graph, const std::vector<KeyframeWithTruth>& walk) {
  const Pose truth = walk.front().T_map_base.inverse() * walk.back().T_map_base;
  const Pose ours =
      graph.keyframes.front().T_map_base.inverse() * graph.keyframes.back().T_map_base;
  return local(truth, ours).head<3>().norm();
}

/// Keyframes from a round of the small building, with odometry that drifts by 0.3 m and a degree.
class GraphSlamOnAWalk : public ::testing::Test {
 protected:
  static std::vector<KeyframeWithTruth> round(const test::WalkErrors& errors) {
    const test::ScanStage stage(sim::test::shipped("small"), sim::lidarNamed("vlp16_sparse"));
    return test::walk(stage, test::roundOfTheSmallBuilding(), errors);
  }
  static void SetUpTestSuite() {
    drifting_ = new std::vector<KeyframeWithTruth>(round({{0.3, 0.0, 0.0}, 1.0 * kRadPerDeg}));
  }
  static void TearDownTestSuite() { delete drifting_; }

  static const std::vector<KeyframeWithTruth>* drifting_;
  static GraphSlamConfig uncompressed() {
    GraphSlamConfig config;
    config.hierarchy.mode = "baseline";
    return config;
  }
  GraphSlam slam_{uncompressed()};
};
const std::vector<KeyframeWithTruth>* GraphSlamOnAWalk::drifting_ = nullptr;

TEST_F(GraphSlamOnAWalk, ClosesTheLoopThatOdometryLeavesOpen) {
  const Pose T_first_last = drifting_->front().T_map_base.inverse() * drifting_->back().T_map_base;
  const Pose T_odom_last = drifting_->back().keyframe.T_odom_base;
  EXPECT_GT((T_odom_last.translation() - T_first_last.translation()).norm(), 0.25);
  int loops = 0;
  for (const KeyframeWithTruth& step : *drifting_) {
    const KeyframeOutcome outcome = slam_.addKeyframe(step.keyframe);
    EXPECT_EQ(outcome.loop_closures > 0, !outcome.optimizations.empty());
    loops += outcome.loop_closures;
    for (const OptimizationSummary& optimization : outcome.optimizations) {
      EXPECT_TRUE(optimization.converged) << optimization.problem;
      EXPECT_LE(optimization.cost_after, optimization.cost_before);
      EXPECT_EQ(optimization.stamp_s, step.keyframe.stamp_s);
    }
  }
  const GraphSnapshotConstPtr graph = slam_.snapshot();
  EXPECT_GT(loops, 0);
  EXPECT_EQ(graph->keyframes.size(), drifting_->size());
  EXPECT_EQ(graph->factors.size(), drifting_->size() - 1 + static_cast<std::size_t>(loops));
  EXPECT_LT(finalError(*graph, *drifting_), 0.05);
  // the first keyframe stays where it was
  EXPECT_LT(local(graph->keyframes[0].T_map_base, drifting_->front().keyframe.T_odom_base).norm(),
            1e-9);
}

TEST_F(GraphSlamOnAWalk, KeepsAGoodMapAsItIs) {
  const auto walk = round({});
  for (const KeyframeWithTruth& step : walk) slam_.addKeyframe(step.keyframe);
  const GraphSnapshotConstPtr graph = slam_.snapshot();
  for (std::size_t k = 0; k < walk.size(); ++k) {
    const Pose truth = walk.front().T_map_base.inverse() * walk[k].T_map_base;
    EXPECT_LT(local(truth, graph->keyframes[k].T_map_base).head<3>().norm(), 0.03) << k;
  }
}

TEST_F(GraphSlamOnAWalk, DriftIsThatOfTheNewestKeyframe) {
  for (const KeyframeWithTruth& step : *drifting_) {
    const KeyframeOutcome outcome = slam_.addKeyframe(step.keyframe);
    const GraphSnapshotConstPtr graph = slam_.snapshot();
    const KeyframeNode& newest = graph->keyframes.back();
    EXPECT_EQ(newest.id, outcome.id);
    EXPECT_EQ(graph->stamp_s, step.keyframe.stamp_s);
    EXPECT_EQ(newest.T_odom_base.matrix(), step.keyframe.T_odom_base.matrix());
    EXPECT_LT(local(newest.T_map_base, slam_.T_map_odom() * newest.T_odom_base).norm(), 1e-9);
    EXPECT_EQ(graph->T_map_odom.matrix(), slam_.T_map_odom().matrix());
  }
  EXPECT_GT(slam_.T_map_odom().translation().norm(), 0.1) << "it has found some";
}

TEST_F(GraphSlamOnAWalk, OdometryEdgesAreAsMeasured) {
  for (const KeyframeWithTruth& step : *drifting_) slam_.addKeyframe(step.keyframe);
  std::size_t k = 0;
  const GraphSnapshotConstPtr graph = slam_.snapshot();
  for (const StoredFactor& stored : graph->factors) {
    const RelativePoseFactor& edge = *keyframeEdge(*stored.factor);
    if (edge.kind == RelativePoseFactor::Kind::kLoopClosure) {
      EXPECT_EQ(edge.kernel().kind, RobustKernel::Kind::kCauchy);
      EXPECT_EQ(edge.kernel().width_chi2, SolverConfig().loop_kernel_chi2);
      continue;
    }
    EXPECT_EQ(edge.kernel().kind, RobustKernel::Kind::kNone);
    const Keyframe& from = (*drifting_)[k].keyframe;
    const Keyframe& to = (*drifting_)[k + 1].keyframe;
    EXPECT_EQ(edge.node(0), NodeId(KeyframeId{k}));
    EXPECT_EQ(edge.node(1), NodeId(KeyframeId{k + 1}));
    EXPECT_LT(local(from.T_odom_base.inverse() * to.T_odom_base, edge.T_from_to).norm(), 1e-9);
    EXPECT_TRUE(edge.information().isApprox(Matrix6(to.covariance.inverse()), 1e-9));
    ++k;
  }
  EXPECT_EQ(k, drifting_->size() - 1);
}

TEST_F(GraphSlamOnAWalk, SnapshotsAreNewAfterEveryChangeAndStayAsTheyWere) {
  GraphSnapshotConstPtr last = slam_.snapshot();
  ASSERT_NE(last, nullptr);
  for (const KeyframeWithTruth& step : *drifting_) {
    slam_.addKeyframe(step.keyframe);
    const GraphSnapshotConstPtr now = slam_.snapshot();
    EXPECT_NE(now, last);
    EXPECT_EQ(now, slam_.snapshot());
    EXPECT_EQ(now->keyframes.size(), last->keyframes.size() + 1);
    last = now;
  }
  const Pose before = last->keyframes.back().T_map_base;
  slam_.optimize();
  EXPECT_NE(slam_.snapshot(), last);
  EXPECT_EQ(last->keyframes.back().T_map_base.matrix(), before.matrix());
}

TEST_F(GraphSlamOnAWalk, GoesOnAfterKeyframesThatItRefused) {
  const auto keyframe = [](std::size_t k) { return (*drifting_)[k].keyframe; };
  Keyframe empty = keyframe(0);
  empty.cloud.reset(new Cloud);
  EXPECT_THROW(slam_.addKeyframe(empty), std::invalid_argument);
  slam_.addKeyframe(keyframe(0));
  slam_.addKeyframe(keyframe(1));
  EXPECT_THROW(slam_.addKeyframe(keyframe(1)), std::invalid_argument) << "of the same stamp";
  EXPECT_THROW(slam_.addKeyframe(keyframe(0)), std::invalid_argument) << "an older one";
  EXPECT_EQ(slam_.addKeyframe(keyframe(2)).id, KeyframeId{2});
  EXPECT_EQ(slam_.snapshot()->factors.size(), 2U);
}

TEST_F(GraphSlamOnAWalk, SameKeyframesSameGraph) {
  GraphSlam other{uncompressed()};
  for (const KeyframeWithTruth& step : *drifting_) {
    slam_.addKeyframe(step.keyframe);
    other.addKeyframe(step.keyframe);
  }
  const GraphSnapshotConstPtr a = slam_.snapshot();
  const GraphSnapshotConstPtr b = other.snapshot();
  for (std::size_t k = 0; k < drifting_->size(); ++k) {
    EXPECT_EQ(a->keyframes[k].T_map_base.matrix(), b->keyframes[k].T_map_base.matrix());
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
