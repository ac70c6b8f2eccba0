// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>

#include "mrpt_sgraphs/slam/pipeline.h"
#include "support/flat_world.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kNoise_m = 0.015;
constexpr double kScanEvery_s = 1.0;

/// A lidar in a room with a wall that stands into it, one scan after the other.
class LidarInARoom {
 public:
  LidarInARoom() : pipeline_(instantaneousScans()) {
    world_ = test::FlatWorld::box({-6, -3, 0}, {6, 3, 2.8});
    const Eigen::Vector3d up(0, 0, 2.8);
    world_.rectangles.push_back({{0, 1, 0}, {0, 2, 0}, up});
    world_.rectangles.push_back({{0.2, 1, 0}, {0, 2, 0}, up});
    world_.rectangles.push_back({{0, 1, 0}, {0.2, 0, 0}, up});
  }

  Cloud scanFrom(double x_m) {
    Pose T_world_lidar = Pose::Identity();
    T_world_lidar.translation() << x_m, -0.5, 1.0;
    return test::scanOf(world_, pattern_, T_world_lidar, kNoise_m, &random_);
  }

  void take(const Cloud& cloud) {
    std::vector<float> data;
    for (const Point& p : cloud) data.insert(data.end(), {p.x, p.y, p.z});
    RawCloud raw;
    raw.stamp_s = 1000.0 + kScanEvery_s * scans_++;
    raw.frame_id = "lidar";
    raw.width = static_cast<std::uint32_t>(cloud.size());
    raw.height = 1;
    raw.point_step = 3 * sizeof(float);
    raw.row_step = raw.width * raw.point_step;
    for (std::uint32_t k = 0; k < 3; ++k) {
      raw.fields.push_back({std::string(1, "xyz"[k]), k * 4U, RawCloud::Type::kFloat32, 1});
    }
    raw.data = reinterpret_cast<const std::uint8_t*>(data.data());
    raw.size = data.size() * sizeof(float);
    pipeline_.addScan(raw, Pose::Identity(), "lidar");
  }

  GraphSnapshotConstPtr graph() const { return pipeline_.graph(); }

 private:
  static SlamConfig instantaneousScans() {
    SlamConfig config;
    config.prefilter.sweep_period_s = 0.0;
    return config;
  }

  Pipeline pipeline_;
  test::FlatWorld world_;
  const test::Pattern pattern_ =
      test::Pattern::spinning(16, 360, -15.0 * M_PI / 180.0, 15.0 * M_PI / 180.0);
  std::mt19937 random_{3};
  int scans_ = 0;
};

TEST(StandingStill, ForTenMinutesAddsNothing) {
  LidarInARoom lidar;
  for (double x_m = -4.0; x_m < 3.0; x_m += 0.25) lidar.take(lidar.scanFrom(x_m));
  std::vector<Cloud> at_rest;
  for (int k = 0; k < 30; ++k) at_rest.push_back(lidar.scanFrom(3.0));
  // the last keyframe comes a while after the last step
  for (const Cloud& scan : at_rest) lidar.take(scan);
  const GraphSnapshotConstPtr arrived = lidar.graph();
  ASSERT_GE(arrived->walls.size(), 5U);
  ASSERT_EQ(arrived->floors.size(), 1U);

  for (std::size_t k = 0; k < static_cast<std::size_t>(600.0 / kScanEvery_s); ++k) {
    lidar.take(at_rest[k % at_rest.size()]);
  }
  const GraphSnapshotConstPtr rested = lidar.graph();
  EXPECT_EQ(rested->walls.size(), arrived->walls.size());
  EXPECT_EQ(rested->keyframes.size(), arrived->keyframes.size());
  EXPECT_EQ(rested->factors.size(), arrived->factors.size());
  EXPECT_EQ(rested->floors.size(), 1U);
}

}  // namespace
}  // namespace mrpt_sgraphs
