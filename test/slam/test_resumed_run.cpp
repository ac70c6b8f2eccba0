// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <sstream>

#include "io/temporary_folder.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/graph_state.h"
#include "mrpt_sgraphs/slam/pipeline.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

/// A run that can be stopped between any two scans.
class Player {
 public:
  Player(const test::SimulatedRun& run, const SlamConfig& config)
      : run_(run), config_(config), pipeline_(std::make_unique<Pipeline>(config)) {}

  void playUntil(std::size_t end) {
    for (; next_ < end; ++next_) {
      constexpr double kSweep_s = 0.1;
      const double until_s = run_.truth[next_].stamp_s + 1.1 * kSweep_s;
      for (; imu_ < run_.imu.size() && run_.imu[imu_].stamp_s < until_s; ++imu_) {
        pipeline_->addImu(run_.imu[imu_]);
      }
      const test::OwnedRawCloud raw = run_.rawCloud(next_);
      pipeline_->addScan(raw.view(), run_.T_base_lidar, "base_link");
    }
  }

  void dump(const std::string& folder) { writeRun(folder, pipeline_->record()); }
  void load(const std::string& folder) {
    pipeline_ = std::make_unique<Pipeline>(config_);
    pipeline_->restore(StateReader(folder));
    imu_ = 0;  // what it knows it does not take twice
  }
  Pipeline& pipeline() { return *pipeline_; }

 private:
  const test::SimulatedRun& run_;
  SlamConfig config_;
  std::unique_ptr<Pipeline> pipeline_;
  std::size_t next_ = 0;
  std::size_t imu_ = 0;
};

std::string jsonOf(const GraphSnapshot& graph) {
  std::ostringstream out;
  writeGraphJson(graph, out);
  return out.str();
}

class WalkInABuilding : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = new test::SimulatedRun(test::simulatedRun(sim::test::shipped("small"), "vlp16_sparse"));
  }
  static void TearDownTestSuite() { delete run_; }

  static const test::SimulatedRun* run_;
};
const test::SimulatedRun* WalkInABuilding::run_ = nullptr;

class ResumedRun : public WalkInABuilding, public ::testing::WithParamInterface<const char*> {
 protected:
  static SlamConfig config() {
    SlamConfig config;
    config.hierarchy.mode = GetParam();
    return config;
  }
};

/// Stopped five times, it is the same to the last bit: the graph, where every scan was, and what it
/// would do next.
TEST_P(ResumedRun, IsTheRunThatDidNotStop) {
  const std::size_t scans = run_->scans.size();
  Player straight(*run_, config());
  straight.playUntil(scans);
  straight.pipeline().finish();
  const RunRecord expected = straight.pipeline().record();

  const test::TemporaryFolder folder;
  Player resumed(*run_, config());
  for (std::size_t stop = 1; stop <= 5; ++stop) {
    resumed.playUntil(stop * scans / 6 + stop);  // not where anything else happens
    resumed.dump(folder.file("map"));
    const std::string before = jsonOf(*resumed.pipeline().graph());
    resumed.load(folder.file("map"));
    EXPECT_EQ(jsonOf(*resumed.pipeline().graph()), before) << "stop " << stop;
    std::istringstream written(folder.read("map/graph.json"));
    EXPECT_EQ(jsonOf(*readGraphJson(written).snapshot()), before);
  }
  resumed.playUntil(scans);
  resumed.pipeline().finish();
  const RunRecord actual = resumed.pipeline().record();

  EXPECT_EQ(jsonOf(*actual.graph), jsonOf(*expected.graph));
  EXPECT_EQ(actual.state.at("state/rooms.bin"), expected.state.at("state/rooms.bin"));
  EXPECT_EQ(actual.state.at("state/front_end.bin"), expected.state.at("state/front_end.bin"));
  ASSERT_EQ(actual.trajectory.size(), expected.trajectory.size());
  for (std::size_t k = 0; k < expected.trajectory.size(); ++k) {
    EXPECT_EQ(actual.trajectory[k].stamp_s, expected.trajectory[k].stamp_s);
    EXPECT_TRUE(actual.trajectory[k].T_world_body.matrix() ==
                expected.trajectory[k].T_world_body.matrix())
        << "scan " << k;
  }
  ASSERT_EQ(actual.optimizations.size(), expected.optimizations.size());
  for (std::size_t k = 0; k < expected.optimizations.size(); ++k) {
    EXPECT_EQ(actual.optimizations[k].kind, expected.optimizations[k].kind) << k;
    EXPECT_EQ(actual.optimizations[k].cost_after, expected.optimizations[k].cost_after) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, ResumedRun, ::testing::Values("baseline", "paper", "condensed"));

using SavedRun = WalkInABuilding;

TEST_F(SavedRun, HasItsParametersAsAFile) {
  SlamConfig config;
  config.hierarchy.mode = "paper";
  config.odometry.registration.range_sigma_m = 1.0 / 90.0;
  const test::TemporaryFolder folder;
  Player player(*run_, config);
  player.playUntil(30);
  player.dump(folder.file("map"));
  config.hierarchy.budget_ms = 0.0;  // offline there is none
  EXPECT_EQ(parameterList(loadConfigFile(folder.file("map/parameters.yaml"))),
            parameterList(config));
}

/// What came after a dump is in the graph, as the front end gave it.
TEST_F(SavedRun, CanBeFollowedByWhatCameSince) {
  Player player(*run_, SlamConfig{});
  player.playUntil(run_->scans.size() / 2);
  const GraphSnapshotConstPtr earlier = player.pipeline().graph();
  player.playUntil(run_->scans.size() * 2 / 3);
  const GraphSnapshotConstPtr later = player.pipeline().graph();
  EXPECT_TRUE(goesOnFrom(*later, *earlier));
  EXPECT_FALSE(goesOnFrom(*earlier, *later));
  const std::vector<Keyframe> since = keyframesAfter(earlier->stamp_s, *later);
  ASSERT_EQ(since.size(), later->keyframes.size() - earlier->keyframes.size());
  EXPECT_GT(since.front().stamp_s, earlier->stamp_s);
  EXPECT_EQ(since.back().cloud, later->keyframes.back().cloud);
  for (const Keyframe& keyframe : since) {
    EXPECT_GT(keyframe.covariance.diagonal().minCoeff(), 0.0);
    EXPECT_LT(keyframe.covariance.diagonal().maxCoeff(), 0.01);
  }
}

TEST_F(SavedRun, SaysWhereItIsDamaged) {
  const test::TemporaryFolder folder;
  Player player(*run_, SlamConfig{});
  player.playUntil(run_->scans.size() / 2);
  player.dump(folder.file("map"));

  std::string bytes = folder.read("map/state/graph.bin");
  ASSERT_GT(bytes.size(), 200000U);
  bytes[150000] = static_cast<char>(bytes[150000] ^ 4);
  folder.write("map/state/graph.bin", bytes);
  std::string message = test::messageOf<std::runtime_error>([&] { player.load(folder.file("map")); });
  EXPECT_NE(message.find("state/graph.bin' is damaged between byte 131072 and byte 196608"),
            std::string::npos)
      << message;

  folder.write("map/state/graph.bin", bytes.substr(0, 100000));
  message = test::messageOf<std::runtime_error>([&] { player.load(folder.file("map")); });
  EXPECT_NE(message.find("ends at byte 100000"), std::string::npos) << message;
}

}  // namespace
}  // namespace mrpt_sgraphs
