// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "mrpt_sgraphs/io/trajectory_error.h"
#include "mrpt_sgraphs/slam/pipeline.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kDay_s = 86400.0;
constexpr double kSameStamp_s = 1e-3;

/// Some scans of a walk, on another day.
void play(const test::SimulatedRun& run, std::size_t begin, std::size_t end, double later_s,
          Pipeline* pipeline) {
  for (std::size_t k = begin; k < end; ++k) {
    test::OwnedRawCloud raw = run.rawCloud(k);
    raw.header.stamp_s += later_s;
    pipeline->addScan(raw.view(), run.T_base_lidar, "base_link");
  }
}

class SecondSession : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = new test::SimulatedRun(test::simulatedRun(sim::test::shipped("small"), "vlp16_sparse"));
    folder_ = new test::TemporaryFolder;
    Pipeline pipeline(SlamConfig{});
    play(*run_, 0, run_->scans.size(), 0.0, &pipeline);
    pipeline.finish();
    map_ = new RunRecord(pipeline.record());
    writeRun(folder_->file("map"), *map_);
  }
  static void TearDownTestSuite() {
    delete map_;
    delete folder_;
    delete run_;
  }

  static double ateOf(const Trajectory& trajectory) {
    Trajectory truth = run_->truth;
    for (const StampedPose& pose : run_->truth) {
      truth.push_back({pose.stamp_s + kDay_s, pose.T_world_body});
    }
    return evaluateTrajectory(truth, trajectory, kSameStamp_s).ate_m.rmse;
  }

  static const test::SimulatedRun* run_;
  static const test::TemporaryFolder* folder_;
  static const RunRecord* map_;
};
const test::SimulatedRun* SecondSession::run_ = nullptr;
const test::TemporaryFolder* SecondSession::folder_ = nullptr;
const RunRecord* SecondSession::map_ = nullptr;

TEST_F(SecondSession, JoinsTheMapFromItsFirstScanOnAlsoWhereItStartsElsewhere) {
  const std::size_t begin = run_->scans.size() / 3;
  Pipeline pipeline(SlamConfig{});
  pipeline.restore(StateReader(folder_->file("map")));
  play(*run_, begin, run_->scans.size(), kDay_s, &pipeline);
  EXPECT_EQ(pipeline.waitingFor(), "");
  pipeline.finish();
  const RunRecord both = pipeline.record();

  ASSERT_EQ(both.trajectory.size(), 2 * run_->scans.size() - begin);
  EXPECT_EQ(both.graph->rooms.size(), map_->graph->rooms.size()) << "rooms are counted once";
  EXPECT_LE(both.graph->walls.size(), map_->graph->walls.size() + 2);
  EXPECT_EQ(both.graph->floors.size(), 1U);
  EXPECT_LT(ateOf(both.trajectory), 1.2 * ateOf(map_->trajectory));
  EXPECT_LT(both.data_s, 2.0 * map_->data_s);
}

TEST_F(SecondSession, IsNotPartOfTheMapBeforeItsPlaceIsKnown) {
  Pipeline pipeline(SlamConfig{});
  pipeline.restore(StateReader(folder_->file("map")));
  play(*run_, 0, 2, kDay_s, &pipeline);
  EXPECT_NE(pipeline.waitingFor(), "");
  EXPECT_EQ(pipeline.graph()->keyframes.size(), map_->graph->keyframes.size());
  EXPECT_EQ(pipeline.scans(), run_->scans.size());
}

TEST_F(SecondSession, HasToBeLater) {
  Pipeline pipeline(SlamConfig{});
  StateReader state(folder_->file("map"));
  pipeline.restore(state);
  EXPECT_NEAR(*pipeline.stamp_s(), run_->truth.back().stamp_s, 1e-3);
  play(*run_, 0, 5, -kDay_s, &pipeline);  // older than all that is known: left out one by one
  EXPECT_EQ(pipeline.scans(), run_->scans.size());
}

}  // namespace
}  // namespace mrpt_sgraphs
