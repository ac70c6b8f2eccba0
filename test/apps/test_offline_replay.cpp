// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "program.h"
#include "recordings.h"
#include "run_files.h"

namespace mrpt_sgraphs::test {
namespace {

const char* const kTopics[] = {"/sgraphs/keyframe", "/sgraphs/keyframe_planes",
                               "/sgraphs/keyframe_points", "/sgraphs/scan_odometry"};

ProgramResult replay(const std::string& bag, const std::string& out,
                     const Arguments& further = {}) {
  Arguments arguments{"--replay", bag, "--out", out};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return runOffline(arguments);
}

/// A run over the whole tour with its front end recorded, made once. The base is not the LiDAR, so
/// that where the sensor was matters.
class OfflineReplayTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const ProgramResult result =
        runOffline(wholeTour().bag(), folder_->file("run"),
                   {"--base-frame", "base_link", "--record", folder_->file("front_end.bag")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string bag() { return folder_->file("front_end.bag"); }

  static void expectTheSameRun(const std::string& name) {
    for (const char* file : {"trajectory.tum", "odometry.tum", "keyframes.tum", "graph.json",
                             "graph.g2o", "map.pcd", "map.bt"}) {
      EXPECT_NE(folder_->read("run/" + std::string(file)), "");
      EXPECT_TRUE(folder_->read(name + "/" + file) == folder_->read("run/" + std::string(file)))
          << file;  // not EXPECT_EQ, which would print them
    }
    EXPECT_EQ(withoutTimes(folder_->read(name + "/optimizations.csv")),
              withoutTimes(folder_->read("run/optimizations.csv")));
    EXPECT_EQ(withoutTimes(folder_->read(name + "/scans.csv")),
              withoutTimes(folder_->read("run/scans.csv")));
  }

  static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(OfflineReplayTest, GivesTheSameFilesAsTheRunItself) {
  const ProgramResult result = replay(bag(), folder_->file("replay"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  expectTheSameRun("replay");
}

TEST_F(OfflineReplayTest, LeavesNothingBesideTheRecording) {
  EXPECT_TRUE(std::filesystem::exists(bag()));
  EXPECT_FALSE(std::filesystem::exists(bag() + ".active"));
}

TEST_F(OfflineReplayTest, ReportHasTheParametersThatWereUsed) {
  ASSERT_EQ(replay(bag(), folder_->file("modes"), {"--mode", "baseline"}).exit_code, 0);
  const Json parameters = Json::parse(folder_->read("modes/report.json")).at("parameters");
  EXPECT_EQ(parameters.at("hierarchy/mode"), "baseline");
  EXPECT_FALSE(parameters.contains("odometry/map_points")) << "the recording's, not this run's";
}

/// As it comes from `rosbag record`: by the time of arrival, where planes take their time.
TEST_F(OfflineReplayTest, MessagesMayComeLateAndInAnotherNamespace) {
  const std::map<std::string, RecordedAs> arrivals{{kTopics[0], {"/robot/keyframe", 0.02}},
                                                   {kTopics[1], {"/robot/keyframe_planes", 0.35}},
                                                   {kTopics[2], {"/robot/keyframe_points", 0.01}},
                                                   {kTopics[3], {"/robot/scan_odometry", 0.03}}};
  const std::string live = folder_->file("live.bag");
  writeRerecorded(bag(), live, [&](const std::string& topic) {
    return std::vector<RecordedAs>{arrivals.at(topic)};
  });
  const ProgramResult result = replay(live, folder_->file("live"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  expectTheSameRun("live");
}

TEST_F(OfflineReplayTest, WhatComesAfterARestartIsLeftOut) {
  const std::string again = folder_->file("again.bag");
  for (const auto& [write, why] : {std::pair(&writeTwoSessions, "has started again before it"),
                                   std::pair(&writeTwice, "not newer than the last one")}) {
    write(bag(), again);
    const ProgramResult result = replay(again, folder_->file("again"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.says(why)) << result.err;
    EXPECT_TRUE(result.says("messages left out: ")) << result.err;
    expectTheSameRun("again");
  }
}

TEST_F(OfflineReplayTest, StopsAfterTheDuration) {
  ASSERT_EQ(replay(bag(), folder_->file("short"), {"--duration", "3.05"}).exit_code, 0);
  EXPECT_EQ(readTum(folder_->file("short/trajectory.tum")).size(), 31U);
}

TEST_F(OfflineReplayTest, ABagWithoutOneOfTheTopicsIsRefusedByItsName) {
  const std::string without = folder_->file("without.bag");
  for (const std::string missing : kTopics) {
    writeRerecorded(bag(), without, [&](const std::string& topic) {
      return topic == missing ? std::vector<RecordedAs>{} : std::vector<RecordedAs>{{topic}};
    });
    const ProgramResult result = replay(without, folder_->file("refused"));
    EXPECT_EQ(result.exit_code, kFailed) << missing;
    EXPECT_TRUE(result.says("no topic '")) << result.err;
    EXPECT_TRUE(result.says(missing.substr(missing.rfind('/') + 1) + "' of type ")) << result.err;
    EXPECT_TRUE(result.says("it has:\n")) << result.err;
  }
  const ProgramResult raw = replay(wholeTour().bag(), folder_->file("refused"));
  EXPECT_EQ(raw.exit_code, kFailed);
  EXPECT_TRUE(raw.says("no topic 'keyframe' of type mrpt_sgraphs/KeyframeStamped in the bag"))
      << raw.err;
  EXPECT_TRUE(raw.says("/points (sensor_msgs/PointCloud2)")) << raw.err;
  EXPECT_FALSE(std::filesystem::exists(folder_->file("refused")));
}

TEST_F(OfflineReplayTest, KeyframesOfSeveralRobotsAreRefused) {
  const std::string both = folder_->file("both.bag");
  writeRerecorded(bag(), both, [](const std::string& topic) {
    return std::vector<RecordedAs>{{"/a" + topic}, {"/b" + topic}};
  });
  const ProgramResult result = replay(both, folder_->file("refused"));
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("'/a/sgraphs/keyframe' and '/b/sgraphs/keyframe'")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_->file("refused")));
}

TEST_F(OfflineReplayTest, ADamagedRecordingGivesWhatCanBeRead) {
  const std::string damaged = folder_->file("damaged.bag");
  std::filesystem::copy_file(bag(), damaged);
  std::fstream stream(damaged, std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(indexPosition(damaged) / 2);
  stream.seekg(middle);
  const int byte = stream.get();
  stream.seekp(middle);
  stream.put(static_cast<char>(byte ^ 8));
  stream.close();
  const ProgramResult result = replay(damaged, folder_->file("damaged"));
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("'" + damaged + "' is damaged (")) << result.err;
  EXPECT_TRUE(result.says("what could be read is written")) << result.err;
  EXPECT_GT(readTum(folder_->file("damaged/keyframes.tum")).size(), 10U);
}

TEST_F(OfflineReplayTest, ARecordingThatCannotBeWrittenIsSaidBeforeTheWork) {
  const std::string nowhere = folder_->file("none/front_end.bag");
  const ProgramResult result =
      runOffline(tenSeconds().bag(), folder_->file("vain"), {"--record", nowhere});
  EXPECT_EQ(result.exit_code, kFailed);
  EXPECT_TRUE(result.says("cannot write '" + nowhere + "': No such file or directory"))
      << result.err;
  EXPECT_EQ(result.out, "");
}

}  // namespace
}  // namespace mrpt_sgraphs::test
