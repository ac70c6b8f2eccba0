// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/slam/scan_trajectory.h"

#include <gtest/gtest.h>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

/// Scans every 0.1 s along x at 1 m/s, keyframes every second.
struct Walk {
  Walk() {
    for (int i = 0; i <= 25; ++i) {
      Pose T = Pose::Identity();
      T.translation().x() = 0.1 * i;
      scans.add(0.1 * i, T);
      if (i % 10 != 0) continue;
      KeyframeNode keyframe;
      keyframe.id = KeyframeId{static_cast<uint64_t>(i / 10)};
      keyframe.stamp_s = 0.1 * i;
      keyframe.T_odom_base = T;
      keyframe.T_map_base = T;
      graph.keyframes.push_back(keyframe);
    }
  }
  ScanTrajectory scans;
  GraphSnapshot graph;
};

TEST(ScanTrajectory, WithoutDriftIsTheOdometry) {
  const Walk walk;
  const Trajectory corrected = walk.scans.corrected(walk.graph);
  ASSERT_EQ(corrected.size(), 26U);
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    EXPECT_TRUE(corrected[i].T_world_body.isApprox(walk.scans.odometry()[i].T_world_body, 1e-12));
  }
}

TEST(ScanTrajectory, PassesThroughTheKeyframesAndSharesOutBetweenThem) {
  Walk walk;
  walk.graph.keyframes.edit(1).T_map_base.translation().y() = 0.2;
  const Trajectory corrected = walk.scans.corrected(walk.graph);
  EXPECT_NEAR(corrected[0].T_world_body.translation().y(), 0.0, 1e-12);
  EXPECT_NEAR(corrected[5].T_world_body.translation().y(), 0.1, 1e-9);
  EXPECT_NEAR(corrected[10].T_world_body.translation().y(), 0.2, 1e-12);
  EXPECT_NEAR(corrected[15].T_world_body.translation().y(), 0.1, 1e-9);
}

TEST(ScanTrajectory, FollowsTheLastKeyframePastIt) {
  Walk walk;
  const Pose T_moved = test::RandomGeometry(8, 3.0).pose();
  KeyframeNode& last = walk.graph.keyframes.edit(walk.graph.keyframes.size() - 1);
  last.T_map_base = T_moved * last.T_odom_base;
  const Trajectory corrected = walk.scans.corrected(walk.graph);
  EXPECT_TRUE(corrected.back().T_world_body.isApprox(
      T_moved * walk.scans.odometry().back().T_world_body, 1e-9));
}

TEST(ScanTrajectory, WithoutKeyframesIsTheOdometry) {
  const Walk walk;
  EXPECT_EQ(walk.scans.corrected(GraphSnapshot{}).size(), 26U);
}

}  // namespace
}  // namespace mrpt_sgraphs
