// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/slam/pipeline.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/trajectory_error.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

/// Everything that a run measures, in the order in which it would come.
RunRecord play(const test::SimulatedRun& run, const SlamConfig& config,
               const FrontEndListener& listener = {}) {
  Pipeline pipeline(config, listener);
  std::size_t imu = 0;
  std::size_t odom = 0;
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    constexpr double kSweep_s = 0.1;
    const double until_s = run.truth[k].stamp_s + 1.1 * kSweep_s;
    for (; imu < run.imu.size() && run.imu[imu].stamp_s < until_s; ++imu) {
      pipeline.addImu(run.imu[imu]);
    }
    for (; odom < run.odom.size() && run.odom[odom].stamp_s < until_s; ++odom) {
      pipeline.addOdom(run.odom[odom]);
    }
    const test::OwnedRawCloud raw = run.rawCloud(k);
    EXPECT_EQ(pipeline.addScan(raw.view(), run.T_base_lidar, "base_link"), "") << "scan " << k;
  }
  EXPECT_EQ(pipeline.scans(), run.scans.size());
  pipeline.finish();
  return pipeline.record();
}

std::string graphJson(const RunRecord& run) {
  std::ostringstream out;
  writeGraphJson(*run.graph, out);
  return out.str();
}

class PipelineInABuilding : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = new test::SimulatedRun(test::simulatedRun(sim::test::shipped("small"), "vlp16_sparse"));
    record_ = new RunRecord(play(*run_, SlamConfig{}));
  }
  static void TearDownTestSuite() {
    delete record_;
    delete run_;
  }

  static const test::SimulatedRun* run_;
  static const RunRecord* record_;
};
const test::SimulatedRun* PipelineInABuilding::run_ = nullptr;
const RunRecord* PipelineInABuilding::record_ = nullptr;

TEST_F(PipelineInABuilding, RecordsEveryScan) {
  const std::size_t scans = run_->scans.size();
  ASSERT_EQ(record_->scans.size(), scans);
  ASSERT_EQ(record_->odometry.size(), scans);
  ASSERT_EQ(record_->trajectory.size(), scans);
  std::size_t keyframes = 0;
  for (std::size_t k = 0; k < scans; ++k) {
    const ScanReport& report = record_->scans[k];
    EXPECT_NEAR(report.stamp_s, run_->truth[k].stamp_s, 1e-6);
    EXPECT_EQ(report.stamp_s, record_->odometry[k].stamp_s);
    EXPECT_EQ(report.stamp_s, record_->trajectory[k].stamp_s);
    EXPECT_TRUE(report.registered) << k;
    for (const double time_ms : {report.prefilter_ms, report.deskew_ms, report.register_ms,
                                 report.map_ms, report.select_ms, report.segment_ms,
                                 report.keyframe_ms, report.rooms_ms}) {
      EXPECT_GE(time_ms, 0.0);
    }
    EXPECT_EQ(report.rss_mib > 0.0, report.keyframe);
    keyframes += report.keyframe ? 1 : 0;
  }
  EXPECT_EQ(keyframes, record_->graph->keyframes.size());
  SlamConfig used;
  used.hierarchy.budget_ms = 0.0;
  EXPECT_EQ(record_->parameters, parameterList(used));
}

TEST_F(PipelineInABuilding, FollowsTheWalk) {
  const auto ate = [](const Trajectory& poses) {
    constexpr double kSameStamp_s = 1e-3;
    return evaluateTrajectory(run_->truth, poses, kSameStamp_s).ate_m.rmse;
  };
  EXPECT_LT(ate(record_->odometry), 0.02);
  EXPECT_LT(ate(record_->trajectory), 0.02);
}

TEST_F(PipelineInABuilding, TrajectoryGoesThroughTheKeyframes) {
  std::size_t scan = 0;
  for (const KeyframeNode& keyframe : record_->graph->keyframes) {
    while (record_->trajectory[scan].stamp_s < keyframe.stamp_s) ++scan;
    ASSERT_EQ(record_->trajectory[scan].stamp_s, keyframe.stamp_s);
    const Pose& T_map_base = record_->trajectory[scan].T_world_body;
    EXPECT_LT(local(T_map_base, keyframe.T_map_base).norm(), 1e-6);
    if (keyframe.cloud == nullptr) {  // another one shows the place
      EXPECT_TRUE(keyframe.marginalized);
    } else {
      EXPECT_EQ(keyframe.cloud->header.frame_id, "base_link");
    }
  }
}

TEST_F(PipelineInABuilding, SaysOfEveryRoomWhatWasDroppedThere) {
  int dropped = 0;
  std::set<RoomId> rooms;
  for (const OptimizationSummary& summary : record_->optimizations) {
    SCOPED_TRACE(summary.kind);
    if (summary.kind == "room_local") EXPECT_TRUE(summary.room);
    if (summary.kind != "condense") {
      EXPECT_EQ(summary.dropped, 0);
      continue;
    }
    dropped += summary.dropped;
    EXPECT_EQ(dropped, summary.keyframes_marginalized);
    if (summary.room) rooms.insert(*summary.room);
  }
  EXPECT_GT(dropped, 0);
  std::set<RoomId> rooms_of_dropped;
  int marginalized = 0;
  for (const KeyframeNode& keyframe : record_->graph->keyframes) {
    if (!keyframe.marginalized) continue;
    ++marginalized;
    if (keyframe.room) rooms_of_dropped.insert(*keyframe.room);
  }
  EXPECT_EQ(dropped, marginalized);
  EXPECT_EQ(rooms, rooms_of_dropped);
}

TEST_F(PipelineInABuilding, SameInputSameOutput) {
  SlamConfig in_a_hurry;
  in_a_hurry.hierarchy.budget_ms = 1e-3;  // which is for those who cannot wait
  const RunRecord again = play(*run_, in_a_hurry);
  ASSERT_EQ(again.trajectory.size(), record_->trajectory.size());
  for (std::size_t k = 0; k < again.trajectory.size(); ++k) {
    ASSERT_EQ(again.odometry[k].T_world_body.matrix(), record_->odometry[k].T_world_body.matrix());
    ASSERT_EQ(again.trajectory[k].T_world_body.matrix(),
              record_->trajectory[k].T_world_body.matrix());
  }
  ASSERT_EQ(again.graph->keyframes.size(), record_->graph->keyframes.size());
  ASSERT_EQ(again.graph->factors.size(), record_->graph->factors.size());
  ASSERT_EQ(again.optimizations.size(), record_->optimizations.size());
  for (std::size_t k = 0; k < again.graph->keyframes.size(); ++k) {
    ASSERT_EQ(again.graph->keyframes[k].cloud == nullptr,
              record_->graph->keyframes[k].cloud == nullptr);
    if (again.graph->keyframes[k].cloud == nullptr) continue;
    const Cloud& a = *again.graph->keyframes[k].cloud;
    const Cloud& b = *record_->graph->keyframes[k].cloud;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].getVector3fMap(), b[i].getVector3fMap());
    }
  }
}

TEST_F(PipelineInABuilding, ItsListenerHearsAllThatABackEndNeeds) {
  BackEnd back_end{SlamConfig{}};
  FrontEndListener listener;
  listener.on_scan = [&](const OdometryResult& scan) {
    ScanReport report;
    report.stamp_s = scan.stamp_s;
    back_end.addScan({scan.stamp_s, scan.T_odom_base, scan.covariance}, report);
  };
  listener.on_keyframe = [&](const Keyframe& keyframe, double segment_ms) {
    back_end.addKeyframe(keyframe, segment_ms);
  };
  play(*run_, SlamConfig{}, listener);
  back_end.finish();
  const RunRecord heard = back_end.record();
  SlamConfig in_force;
  in_force.hierarchy.budget_ms = 0.0;  // offline
  EXPECT_EQ(heard.parameters, parameterList(static_cast<const BackEndConfig&>(in_force)));
  EXPECT_EQ(heard.parameters.count("odometry/map_points"), 0U) << "it had no part in it";
  EXPECT_EQ(heard.data_s, record_->data_s);
  EXPECT_EQ(heard.optimizations.size(), record_->optimizations.size());
  EXPECT_EQ(graphJson(heard), graphJson(*record_));
  ASSERT_EQ(heard.trajectory.size(), record_->trajectory.size());
  for (std::size_t k = 0; k < heard.trajectory.size(); ++k) {
    ASSERT_EQ(heard.trajectory[k].T_world_body.matrix(),
              record_->trajectory[k].T_world_body.matrix());
    EXPECT_EQ(heard.scans[k].keyframe, record_->scans[k].keyframe);
  }
}

TEST_F(PipelineInABuilding, LeavesOutScansThatAreOfNoUse) {
  Pipeline pipeline(SlamConfig{});
  const auto add = [&](const RawCloud& raw) {
    return pipeline.addScan(raw, run_->T_base_lidar, "base_link");
  };
  const test::OwnedRawCloud first = run_->rawCloud(0);
  const test::OwnedRawCloud second = run_->rawCloud(1);
  EXPECT_EQ(add(second.view()), "");
  EXPECT_NE(add(second.view()).find("not newer"), std::string::npos) << "once more";
  EXPECT_NE(add(first.view()).find("not newer"), std::string::npos) << "an earlier one";
  RawCloud broken = run_->rawCloud(2).header;
  EXPECT_NE(add(broken), "") << "without data";
  EXPECT_EQ(pipeline.scans(), 1U);
  const RunRecord record = pipeline.record();
  EXPECT_EQ(record.scans.size(), 1U);
  EXPECT_EQ(record.graph->keyframes.size(), 0U) << "the first one waits for how the robot moves";
}

TEST(Pipeline, OfNothingRecordsNothing) {
  const RunRecord record = Pipeline(SlamConfig{}).record();
  EXPECT_TRUE(record.trajectory.empty());
  EXPECT_TRUE(record.scans.empty());
  ASSERT_NE(record.graph, nullptr);
  EXPECT_TRUE(record.graph->keyframes.empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
