// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/slam/graph_slam.h"

#include <gtest/gtest.h>

namespace mrpt_sgraphs {
namespace {

/// A keyframe at x with a cloud of one corner of a room.
Keyframe keyframeAt(double stamp_s, double x_m) {
  Cloud::Ptr cloud(new Cloud);
  for (int u = 0; u < 40; ++u) {
    for (int v = 0; v < 40; ++v) {
      Point point;
      point.getVector3fMap() << 4.0F, 0.1F * static_cast<float>(u), 0.05F * static_cast<float>(v);
      cloud->push_back(point);
    }
  }
  Keyframe keyframe;
  keyframe.stamp_s = stamp_s;
  keyframe.T_odom_base.translation().x() = x_m;
  keyframe.covariance = 1e-4 * Matrix6::Identity();
  keyframe.cloud = cloud;
  return keyframe;
}

TEST(GraphSlam, ChainsKeyframesByOdometry) {
  GraphSlam slam(GraphSlamConfig{});
  slam.addKeyframe(keyframeAt(1.0, 0.0));
  slam.addKeyframe(keyframeAt(2.0, 1.0));
  const GraphSnapshotConstPtr graph = slam.snapshot();
  ASSERT_EQ(graph->keyframes.size(), 2U);
  ASSERT_EQ(graph->factors.size(), 1U);
  const RelativePoseFactor* const edge = keyframeEdge(*graph->factors[0].factor);
  ASSERT_NE(edge, nullptr);
  EXPECT_NEAR(edge->T_from_to.translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(edge->information()(0, 0), 1e4, 1e-6);
  EXPECT_TRUE(slam.T_map_odom().isApprox(Pose::Identity()));
}

TEST(GraphSlam, SnapshotIsTheSameObjectUntilSomethingChanges) {
  GraphSlam slam(GraphSlamConfig{});
  slam.addKeyframe(keyframeAt(1.0, 0.0));
  const GraphSnapshotConstPtr before = slam.snapshot();
  EXPECT_EQ(before, slam.snapshot());
  slam.addKeyframe(keyframeAt(2.0, 1.0));
  EXPECT_NE(before, slam.snapshot());
  EXPECT_EQ(before->keyframes.size(), 1U) << "a snapshot never changes";
}

TEST(GraphSlam, RefusesKeyframesWithoutCloudOrOutOfOrder) {
  GraphSlam slam(GraphSlamConfig{});
  slam.addKeyframe(keyframeAt(2.0, 0.0));
  Keyframe empty = keyframeAt(3.0, 1.0);
  empty.cloud.reset();
  EXPECT_THROW(slam.addKeyframe(empty), std::invalid_argument);
  EXPECT_THROW(slam.addKeyframe(keyframeAt(2.0, 1.0)), std::invalid_argument);
  Keyframe unknown = keyframeAt(3.0, 1.0);
  unknown.covariance(3, 3) = -1.0;
  EXPECT_THROW(slam.addKeyframe(unknown), std::invalid_argument);
  EXPECT_EQ(slam.snapshot()->keyframes.size(), 1U);
}

TEST(GraphSlam, OptimizesNothingWithoutComplaint) {
  GraphSlam slam(GraphSlamConfig{});
  EXPECT_TRUE(slam.optimize().converged);
  slam.addKeyframe(keyframeAt(1.0, 0.0));
  EXPECT_TRUE(slam.optimize().converged);
}

}  // namespace
}  // namespace mrpt_sgraphs
