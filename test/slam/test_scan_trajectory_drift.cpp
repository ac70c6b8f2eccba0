// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/slam/scan_trajectory.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kScans = 100;
constexpr int kScansPerKeyframe = 20;

/// Odometry of a curve, a scan a second.
Pose T_odom_base(double stamp_s) {
  Tangent delta;
  delta << 0.1 * stamp_s, std::sin(0.1 * stamp_s), 0.01 * stamp_s, 0.0, 0.02, 0.03 * stamp_s;
  return expPose(delta);
}

ScanTrajectory scans() {
  ScanTrajectory trajectory;
  for (int k = 0; k < kScans; ++k) trajectory.add(k, T_odom_base(k));
  return trajectory;
}

/// Keyframes at every twentieth scan, each with the drift that is found there.
template <typename Drift>
GraphSnapshot graphWith(Drift T_map_odom) {
  GraphSnapshot graph;
  for (int k = 0; k < kScans; k += kScansPerKeyframe) {
    KeyframeNode node;
    node.id = KeyframeId{graph.keyframes.size()};
    node.stamp_s = k;
    node.T_odom_base = T_odom_base(k);
    node.T_map_base = T_map_odom(k) * node.T_odom_base;
    graph.keyframes.push_back(node);
  }
  return graph;
}

Pose alongX(double x) { return Pose(Eigen::Translation3d(x, 0.0, 0.0)); }

TEST(ScanTrajectoryDrift, MovesWithTheMap) {
  test::RandomGeometry random(1, 30.0);
  const Pose T_map_odom = random.pose();
  const Trajectory corrected = scans().corrected(graphWith([&](double) { return T_map_odom; }));
  ASSERT_EQ(corrected.size(), static_cast<std::size_t>(kScans));
  for (const StampedPose& scan : corrected) {
    EXPECT_LT(local(scan.T_world_body, T_map_odom * T_odom_base(scan.stamp_s)).norm(), 1e-8);
  }
}

TEST(ScanTrajectoryDrift, IsSharedOutByTime) {
  // grows evenly, and of place alone: every scan is then known
  const auto T_map_odom = [](double stamp_s) {
    return Pose(Eigen::Translation3d(stamp_s * Eigen::Vector3d(0.01, -0.02, 0.003)));
  };
  const GraphSnapshot graph = graphWith(T_map_odom);
  const double last_keyframe_s = graph.keyframes.back().stamp_s;
  EXPECT_EQ(last_keyframe_s, 80.0);
  for (const StampedPose& scan : scans().corrected(graph)) {
    const Pose expected =
        T_map_odom(std::min(scan.stamp_s, last_keyframe_s)) * T_odom_base(scan.stamp_s);
    EXPECT_LT(local(scan.T_world_body, expected).norm(), 1e-9) << scan.stamp_s;
  }
}

TEST(ScanTrajectoryDrift, MakesNoStepsAtKeyframes) {
  test::RandomGeometry random(2);
  std::vector<Pose> drifts;
  for (int k = 0; k < 10; ++k) drifts.push_back(random.smallPose(0.3, 0.05));
  const GraphSnapshot graph = graphWith([&](int stamp_s) {
    return drifts[static_cast<std::size_t>(stamp_s / kScansPerKeyframe)];
  });
  const Trajectory corrected = scans().corrected(graph);
  for (const KeyframeNode& keyframe : graph.keyframes) {
    const Pose& scan = corrected[static_cast<std::size_t>(keyframe.stamp_s)].T_world_body;
    EXPECT_LT(local(scan, keyframe.T_map_base).norm(), 1e-9);
  }
  for (std::size_t k = 1; k < corrected.size(); ++k) {
    const Pose step = corrected[k - 1].T_world_body.inverse() * corrected[k].T_world_body;
    const Pose odom = T_odom_base(double(k) - 1.0).inverse() * T_odom_base(double(k));
    // twenty scans share what two keyframes differ by
    EXPECT_LT(local(odom, step).head<3>().norm(), 2.0 / kScansPerKeyframe) << k;
  }
}

TEST(ScanTrajectoryDrift, BeforeTheFirstKeyframeIsThatOnes) {
  GraphSnapshot graph = graphWith([](double stamp_s) { return alongX(0.1 * stamp_s); });
  graph.keyframes.erase(0);  // the first is now at 20 s
  const Trajectory corrected = scans().corrected(graph);
  for (std::size_t k = 0; k < 20; ++k) {
    const Pose expected = alongX(2.0) * T_odom_base(double(k));
    EXPECT_LT(local(corrected[k].T_world_body, expected).norm(), 1e-9) << k;
  }
}

TEST(ScanTrajectoryDrift, OfNoScansIsNothing) {
  EXPECT_TRUE(ScanTrajectory().corrected({}).empty());
  EXPECT_TRUE(ScanTrajectory().corrected(graphWith([](double) { return alongX(1.0); })).empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
