// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "program.h"
#include "recordings.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr double kMaxDt_s = 0.01;

class DamagedBagTest : public ::testing::Test {
 protected:
  /// A copy of the ten seconds to be damaged.
  std::string copy(Compression compression) const {
    const std::string path = folder_.file("damaged.bag");
    writeCompressed(tenSeconds().bag(), path, compression);
    return path;
  }

  void flipBit(std::size_t position, int bit = 3) const {
    std::fstream bag(folder_.file("damaged.bag"), std::ios::in | std::ios::out | std::ios::binary);
    bag.seekg(static_cast<std::streamoff>(position));
    const int byte = bag.get();
    bag.seekp(static_cast<std::streamoff>(position));
    bag.put(static_cast<char>(byte ^ (1 << bit)));
  }

  /// Nothing is written, nor is a folder made for it.
  ProgramResult runInVain(const std::string& bag) const {
    const ProgramResult result = runOffline(bag, folder_.file("run"));
    EXPECT_EQ(result.exit_code, kFailed) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.says("'" + bag + "'")) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("run")));
    return result;
  }

  TemporaryFolder folder_;
};

TEST_F(DamagedBagTest, MissingFile) {
  EXPECT_TRUE(runInVain(folder_.file("none.bag")).says("No such file or directory"));
}

TEST_F(DamagedBagTest, FileThatIsNoBag) {
  for (const char* text : {"", "hello\n", "#ROSBAG V1.2\n", "#ROSBAG V2.0"}) {
    runInVain(folder_.write("damaged.bag", text));
  }
  EXPECT_TRUE(runInVain(folder_.write("damaged.bag", "hello\n")).says("is no bag"));
  EXPECT_TRUE(runInVain(folder_.path()).says("is a folder"));
}

TEST_F(DamagedBagTest, CutAnywhereTellsHowToMendIt) {
  for (const Compression compression : {Compression::kNone, Compression::kLz4}) {
    const std::string bag = copy(compression);
    const std::size_t index = indexPosition(bag);
    const std::size_t size = std::filesystem::file_size(bag);
    ASSERT_LT(index, size);
    // in the index, at its beginning, in the middle of a chunk, in the bag's header
    for (const std::size_t length :
         {(index + size) / 2, index, index / 2, std::size_t{4000}, std::size_t{20}}) {
      std::filesystem::resize_file(bag, length);
      const ProgramResult result = runInVain(bag);
      EXPECT_TRUE(result.says("cut short")) << length << ": " << result.err;
      EXPECT_TRUE(result.says("'rosbag reindex " + bag + "'")) << result.err;
    }
  }
}

TEST_F(DamagedBagTest, WhatIsOutsideADamagedChunkIsUsed) {
  for (const Compression compression : {Compression::kLz4, Compression::kBz2}) {
    const std::string bag = copy(compression);
    flipBit(indexPosition(bag) / 2);
    const ProgramResult result = runOffline(bag, folder_.file("run"));
    EXPECT_EQ(result.exit_code, kFailed);  // not all that was asked for is there
    EXPECT_TRUE(result.says("'" + bag + "' is damaged (")) << result.err;
    EXPECT_TRUE(result.says("messages lost: ")) << result.err;
    EXPECT_TRUE(result.says("the first on '/points' at 170000000")) << result.err;
    EXPECT_TRUE(result.says("what could be read is written")) << result.err;

    const Trajectory run = readTum(folder_.file("run/trajectory.tum"));
    EXPECT_LT(run.size(), 100U);
    EXPECT_GT(run.size(), 80U);  // a chunk has seven scans
    EXPECT_NEAR(run.back().stamp_s, tenSeconds().lidarTruth().back().stamp_s, 1e-5);
    EXPECT_LT(evaluateTrajectory(tenSeconds().lidarTruth(), run, kMaxDt_s).ate_m.rmse, 0.02);
  }
}

TEST_F(DamagedBagTest, ADamagedFirstChunkDoesNotSpoilTheOthers) {
  const std::string bag = copy(Compression::kLz4);
  flipBit(20000);  // /tf_static and the first scan are here
  const ProgramResult result = runOffline(bag, folder_.file("run"));
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("the first on '/points' at 1700000000.1")) << result.err;
  EXPECT_GT(readTum(folder_.file("run/trajectory.tum")).size(), 80U);

  const ProgramResult without_tf =
      runOffline(bag, folder_.file("base"), {"--base-frame", "base_link"});
  EXPECT_EQ(without_tf.exit_code, kFailed);
  EXPECT_TRUE(without_tf.says("no transform between 'base_link' and 'lidar'")) << without_tf.err;
  EXPECT_TRUE(without_tf.says("messages lost: ")) << "that is why; " << without_tf.err;
}

TEST_F(DamagedBagTest, FlippedBitsDoNotCrashIt) {
  std::mt19937 random(1);
  for (const Compression compression : {Compression::kNone, Compression::kLz4}) {
    const std::string bag = copy(compression);
    const std::size_t size = std::filesystem::file_size(bag);
    for (int trial = 0; trial < 10; ++trial) {
      const std::size_t position = random() % size;
      const int bit = static_cast<int>(random() % 8);
      flipBit(position, bit);
      const ProgramResult result = runOffline(bag, folder_.file("run"));
      flipBit(position, bit);  // back again
      SCOPED_TRACE("bit " + std::to_string(bit) + " of byte " + std::to_string(position));
      if (result.exit_code == 0) continue;  // not every bit of a bag without checksums matters
      EXPECT_EQ(result.exit_code, kFailed);
      EXPECT_TRUE(result.says(bag)) << result.err;
    }
  }
}

TEST_F(DamagedBagTest, NoSuchTopic) {
  const ProgramResult result = runOffline(
      {"--bag", tenSeconds().bag(), "--points", "/velodyne_points", "--out", folder_.file("run")});
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("no topic '/velodyne_points' of type sensor_msgs/PointCloud2"));
  for (const char* topic : {"/points (sensor_msgs/PointCloud2)", "/imu (sensor_msgs/Imu)",
                            "/odom (nav_msgs/Odometry)", "/tf_static (tf2_msgs/TFMessage)"}) {
    EXPECT_TRUE(result.says(topic)) << topic << " in " << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("run")));
}

TEST_F(DamagedBagTest, NoSuchTopicInASplitBagListsEachTopicOnce) {
  writeSplit(tenSeconds().bag(), 5.0, folder_.file("first.bag"), folder_.file("second.bag"));
  const ProgramResult result =
      runOffline({"--bag", folder_.file("first.bag"), "--bag", folder_.file("second.bag"),
                  "--points", "/none", "--out", folder_.file("run")});
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("/imu (")) << result.err;
  EXPECT_EQ(result.err.find("/imu ("), result.err.rfind("/imu ("));
}

TEST_F(DamagedBagTest, TopicOfAnotherType) {
  const std::string& bag = tenSeconds().bag();
  const std::string out = folder_.file("run");
  const ProgramResult points = runOffline({"--bag", bag, "--points", "/imu", "--out", out});
  EXPECT_EQ(points.exit_code, kFailed);
  EXPECT_TRUE(points.says("'/imu' has type sensor_msgs/Imu, expected sensor_msgs/PointCloud2"))
      << points.err;
  const ProgramResult odom = runOffline(bag, out, {"--odom", "/points"});
  EXPECT_EQ(odom.exit_code, kFailed);
  EXPECT_TRUE(odom.says("'/points' has type sensor_msgs/PointCloud2, expected nav_msgs/Odometry"))
      << odom.err;
  const ProgramResult imu = runOffline(bag, out, {"--imu", "/imu/data"});
  EXPECT_EQ(imu.exit_code, kFailed);
  EXPECT_TRUE(imu.says("no topic '/imu/data' of type sensor_msgs/Imu")) << imu.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace mrpt_sgraphs::test
