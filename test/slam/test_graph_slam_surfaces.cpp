// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/slam/graph_slam.h"
#include "support/plane_world.h"

namespace mrpt_sgraphs {
namespace {

/// The walk through six rooms as keyframes, the odometry turning by 0.03 degrees a metre.
std::vector<Keyframe> keyframes() {
  const test::PlaneWorld world = test::sixRooms();
  const std::vector<Pose> walk = test::walkThroughSixRooms();
  std::mt19937 generator(3);
  Cloud::Ptr cloud(new Cloud);
  cloud->push_back(Point());
  std::vector<Keyframe> result;
  const Pose drift = expPose((Tangent() << 0.0, 0.002, 0.0, 0.0, 0.0, 0.0005).finished());
  for (std::size_t k = 0; k < walk.size(); ++k) {
    Keyframe keyframe;
    keyframe.stamp_s = static_cast<double>(k);
    keyframe.T_odom_base =
        k == 0 ? walk[0] : result.back().T_odom_base * (walk[k - 1].inverse() * walk[k]) * drift;
    Tangent sigma;
    sigma << 0.01, 0.01, 0.01, 0.002, 0.002, 0.002;
    keyframe.covariance = sigma.cwiseAbs2().asDiagonal();
    keyframe.cloud = cloud;
    keyframe.planes = world.observe(walk[k], &generator);
    result.push_back(keyframe);
  }
  return result;
}

GraphSlamConfig withoutLoops() {
  GraphSlamConfig config;
  config.loop_closure.enabled = false;
  return config;
}

TEST(GraphSlamSurfaces, WallsHoldTheTrajectory) {
  GraphSlam slam(withoutLoops());
  std::size_t optimizations = 0;
  const std::vector<Keyframe> walk = keyframes();
  for (const Keyframe& keyframe : walk) {
    for (const OptimizationSummary& summary : slam.addKeyframe(keyframe).optimizations) {
      EXPECT_TRUE(summary.converged) << summary.problem;
      ++optimizations;
    }
  }
  EXPECT_GT(optimizations, walk.size() / 2);
  const GraphSnapshotConstPtr graph = slam.snapshot();
  EXPECT_EQ(graph->walls.size(), static_cast<std::size_t>(test::kWallsOfSixRooms));
  const std::vector<Pose> truth = test::walkThroughSixRooms();
  double worst_m = 0.0;
  double worst_odometry_m = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const KeyframeNode& keyframe = graph->keyframes[k];
    const auto error_m = [&](const Pose& T) {
      return (T.translation() - truth[k].translation()).head<2>().norm();
    };
    worst_m = std::max(worst_m, error_m(keyframe.T_map_base));
    worst_odometry_m = std::max(worst_odometry_m, error_m(keyframe.T_odom_base));
    // let go of where another keyframe shows the place
    EXPECT_TRUE(keyframe.planes == walk[k].planes ||
                (keyframe.marginalized && keyframe.planes == nullptr));
  }
  EXPECT_GT(worst_odometry_m, 0.2);
  EXPECT_LT(worst_m, 0.06);
}

TEST(GraphSlamSurfaces, OutlinesLieOnTheWallsOfTheSnapshot) {
  GraphSlam slam(withoutLoops());
  for (const Keyframe& keyframe : keyframes()) {
    slam.addKeyframe(keyframe);
    for (const WallNode& wall : slam.snapshot()->walls) {
      ASSERT_GE(wall.extent_map.outline.size(), 3U);
      for (const Eigen::Vector3d& corner : wall.extent_map.outline) {
        ASSERT_NEAR(wall.plane_map.normal.dot(corner), wall.plane_map.distance, 1e-9);
      }
    }
  }
}

TEST(GraphSlamSurfaces, CanBeSwitchedOff) {
  GraphSlamConfig config = withoutLoops();
  config.walls.enabled = false;
  config.ground.enabled = false;
  config.hierarchy.mode = "baseline";
  GraphSlam slam(config);
  for (const Keyframe& keyframe : keyframes()) {
    EXPECT_TRUE(slam.addKeyframe(keyframe).optimizations.empty());
  }
  const GraphSnapshotConstPtr graph = slam.snapshot();
  EXPECT_EQ(graph->walls.size(), 0U);
  EXPECT_EQ(graph->factors.size(), graph->keyframes.size() - 1);
}

TEST(GraphSlamSurfaces, SameKeyframesSameGraph) {
  GraphSlam a(withoutLoops());
  GraphSlam b(withoutLoops());
  for (const Keyframe& keyframe : keyframes()) {
    a.addKeyframe(keyframe);
    b.addKeyframe(keyframe);
  }
  const GraphSnapshotConstPtr one = a.snapshot();
  const GraphSnapshotConstPtr other = b.snapshot();
  ASSERT_EQ(one->walls.size(), other->walls.size());
  for (std::size_t k = 0; k < one->walls.size(); ++k) {
    EXPECT_EQ(one->walls[k].plane_map.normal, other->walls[k].plane_map.normal);
    EXPECT_EQ(one->walls[k].extent_map.outline, other->walls[k].extent_map.outline);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
