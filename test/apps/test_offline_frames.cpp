// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "program.h"
#include "recordings.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr double kMaxDt_s = 0.01;
constexpr double kMaxAte_m = 0.02;
constexpr double kRightAngle_rad = 1.5707963267948966;

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                          const Pose& T_parent_child) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation.x = T_parent_child.translation().x();
  message.transform.translation.y = T_parent_child.translation().y();
  message.transform.translation.z = T_parent_child.translation().z();
  const Eigen::Quaterniond q(T_parent_child.linear());
  message.transform.rotation.x = q.x();
  message.transform.rotation.y = q.y();
  message.transform.rotation.z = q.z();
  message.transform.rotation.w = q.w();
  return message;
}

class FramesTest : public ::testing::Test {
 protected:
  /// Off by enough to be seen: turned to the side and metres away.
  const Pose T_base_lidar_ = Eigen::Translation3d(1.5, -0.5, 0.3) *
                             Pose(Eigen::AngleAxisd(kRightAngle_rad, Eigen::Vector3d::UnitZ()));

  /// Checks a trajectory against the true one of the base, whose lidar sits at T_base_lidar_.
  void expectBaseOn(const std::string& bag, const std::string& base_frame) const {
    SCOPED_TRACE(base_frame);
    const ProgramResult result = runOffline(bag, folder_.file("run"), {"--base-frame", base_frame});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    Trajectory truth = tenSeconds().lidarTruth();
    for (StampedPose& pose : truth) pose.T_world_body = pose.T_world_body * T_base_lidar_.inverse();
    const Trajectory run = readTum(folder_.file("run/trajectory.tum"));
    const TrajectoryErrors errors = evaluateTrajectory(truth, run, kMaxDt_s);
    EXPECT_EQ(errors.paired, truth.size());
    EXPECT_LT(errors.ate_m.rmse, kMaxAte_m);
  }

  TemporaryFolder folder_;
};

TEST_F(FramesTest, TrajectoryIsThatOfTheBase) {
  ASSERT_EQ(
      runOffline(tenSeconds().bag(), folder_.file("run"), {"--base-frame", "base_link"}).exit_code,
      0);
  const Trajectory run = readTum(folder_.file("run/trajectory.tum"));
  EXPECT_LT(evaluateTrajectory(tenSeconds().baseTruth(), run, kMaxDt_s).ate_m.rmse, kMaxAte_m);
}

TEST_F(FramesTest, StaticTransformsAreFollowed) {
  const std::string bag = folder_.file("moved.bag");
  const Pose T_tower_lidar = Pose(Eigen::Translation3d(0.0, 0.0, 0.4));
  writeWithTransforms(tenSeconds().bag(), bag, "/tf_static",
                      {transform("base_link", "tower", T_base_lidar_ * T_tower_lidar.inverse()),
                       transform("tower", "lidar", T_tower_lidar)});
  expectBaseOn(bag, "base_link");
  expectBaseOn(bag, "/base_link");  // as old files write it
}

TEST_F(FramesTest, TransformsOfTfDoWhereThereAreNoStaticOnes) {
  const std::string bag = folder_.file("tf.bag");
  const Pose T_footprint_base = Pose(Eigen::Translation3d(0.0, 0.2, 0.5));
  writeWithTransforms(tenSeconds().bag(), bag, "/tf",
                      {transform("base_link", "lidar", T_footprint_base.inverse() * T_base_lidar_),
                       transform("footprint", "base_link", T_footprint_base),
                       transform("footprint", "base_link", Pose::Identity())});  // it sways later
  expectBaseOn(bag, "footprint");
}

TEST_F(FramesTest, LeadingSlashesDoNotMatter) {
  const std::string bag = folder_.file("slashes.bag");
  writeWithTransforms(tenSeconds().bag(), bag, "/tf_static",
                      {transform("/base_link", "/lidar", T_base_lidar_)});
  const std::string with_slashes = folder_.file("all_slashes.bag");
  writeWithScans(bag, with_slashes, [](std::size_t, RecordedScan scan) {
    scan.cloud.header.frame_id = "/lidar";
    return RecordedScans{scan};
  });
  expectBaseOn(with_slashes, "base_link");
}

TEST_F(FramesTest, UnknownBaseListsTheFrames) {
  const ProgramResult result =
      runOffline(tenSeconds().bag(), folder_.file("run"), {"--base-frame", "trunk"});
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("no transform between 'trunk' and 'lidar'")) << result.err;
  EXPECT_TRUE(result.says("Frame lidar exists with parent base_link")) << result.err;
  EXPECT_TRUE(result.says("Frame imu_link exists with parent base_link")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("run")));
}

TEST_F(FramesTest, BagsWithoutTransformsRunInTheFrameOfTheClouds) {
  const std::string bag = folder_.file("bare.bag");
  writeWithTransforms(tenSeconds().bag(), bag, "/tf_static", {});
  EXPECT_EQ(runOffline(bag, folder_.file("run")).err, "");

  const ProgramResult sensors =
      runOffline(bag, folder_.file("run"), {"--odom", "/odom", "--imu", "/imu"});
  EXPECT_EQ(sensors.exit_code, 0);
  EXPECT_TRUE(sensors.says("'base_link' and 'lidar' are taken to be one frame")) << sensors.err;
  EXPECT_TRUE(sensors.says("'lidar' and 'imu_link' are taken to be one frame")) << sensors.err;
}

TEST_F(FramesTest, CloudsThatNameNoFrameAreUsed) {
  const std::string bag = folder_.file("nameless.bag");
  writeWithScans(tenSeconds().bag(), bag, [](std::size_t, RecordedScan scan) {
    scan.cloud.header.frame_id.clear();
    return RecordedScans{scan};
  });
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(readTum(folder_.file("run/trajectory.tum")).size(), 100U);
}

}  // namespace
}  // namespace mrpt_sgraphs::test
