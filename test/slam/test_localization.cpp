// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "mrpt_sgraphs/slam/localization.h"
#include "mrpt_sgraphs/slam/localized_run.h"
#include "support/look_alike_rooms.h"

namespace mrpt_sgraphs {
namespace {

using test::KeyframeWithTruth;

constexpr double kMapError_m = 0.03;

class LocalizationTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    map_walk_ = new auto(test::walkWithPlanes(test::lookAlikes(), test::roundOfLookAlikes()));
    map_ = new auto(test::mapOf(*map_walk_));
    Pose T_odom_start = Pose::Identity();
    T_odom_start.translation() << 3.0, -7.0, 0.5;
    T_odom_start.linear() = expSO3({0.0, 0.0, 1.9});
    walk_ = new auto(test::walkWithPlanes(test::lookAlikes(), test::fromEastToWest(), T_odom_start));
  }
  static void TearDownTestSuite() {
    delete walk_;
    delete map_;
    delete map_walk_;
  }

  /// T_map_base.
  static Pose truthOf(const KeyframeWithTruth& step) {
    return test::frameOf(*map_walk_) * step.T_map_base;
  }
  double errorAt(const KeyframeWithTruth& step) const {
    const Pose T_map_base = *localization_.T_map_odom() * step.keyframe.T_odom_base;
    return (T_map_base.translation() - truthOf(step).translation()).norm();
  }

  static const std::vector<KeyframeWithTruth>* map_walk_;
  static const GraphSnapshotConstPtr* map_;
  static const std::vector<KeyframeWithTruth>* walk_;
  Localization localization_{*map_, BackEndConfig{}};
};
const std::vector<KeyframeWithTruth>* LocalizationTest::map_walk_ = nullptr;
const GraphSnapshotConstPtr* LocalizationTest::map_ = nullptr;
const std::vector<KeyframeWithTruth>* LocalizationTest::walk_ = nullptr;

TEST_F(LocalizationTest, FindsTheRobotAndFollowsIt) {
  EXPECT_FALSE(localization_.T_map_odom());
  EXPECT_FALSE(localization_.status().problem.empty());
  std::size_t followed = 0;
  for (const KeyframeWithTruth& step : *walk_) {
    localization_.addKeyframe(step.keyframe);
    if (!localization_.T_map_odom()) {
      EXPECT_EQ(followed, 0U) << localization_.status().problem;
      continue;
    }
    ++followed;
    EXPECT_LT(errorAt(step), kMapError_m) << step.keyframe.stamp_s;
  }
  EXPECT_GT(followed, walk_->size() / 3);
  EXPECT_EQ(localization_.status().relocations, 1);
  EXPECT_EQ(localization_.map(), *map_);
}

TEST_F(LocalizationTest, SaysSoWhenItIsLostAndFindsItselfAgain) {
  for (const KeyframeWithTruth& step : *walk_) localization_.addKeyframe(step.keyframe);
  ASSERT_TRUE(localization_.status().localized);
  // carried to the start with the eyes closed: the odometry knows nothing of it
  const Pose T_odom_jump = walk_->back().keyframe.T_odom_base *
                           walk_->front().keyframe.T_odom_base.inverse();
  bool was_lost = false;
  for (KeyframeWithTruth step : *walk_) {
    step.keyframe.stamp_s += walk_->back().keyframe.stamp_s;
    step.keyframe.T_odom_base = T_odom_jump * step.keyframe.T_odom_base;
    localization_.addKeyframe(step.keyframe);
    was_lost = was_lost || !localization_.status().localized;
    if (was_lost && localization_.status().localized) {
      EXPECT_LT(errorAt(step), kMapError_m);
    }
  }
  EXPECT_TRUE(was_lost);
  EXPECT_TRUE(localization_.status().localized) << localization_.status().problem;
  EXPECT_EQ(localization_.status().relocations, 2);
}

TEST_F(LocalizationTest, BelievesWhoPointsAtThePlaceIfItFits) {
  const KeyframeWithTruth& first = walk_->front();
  Pose off = Pose::Identity();
  off.translation() << 0.5, 0.4, 0.0;
  off.linear() = expSO3({0.0, 0.0, -0.3});
  EXPECT_TRUE(localization_.setInitialPose(truthOf(first) * off));  // kept for the first keyframe
  localization_.addKeyframe(first.keyframe);
  ASSERT_TRUE(localization_.status().localized) << localization_.status().problem;
  EXPECT_LT(errorAt(first), kMapError_m);

  Pose elsewhere = truthOf(first);
  elsewhere.translation() += Eigen::Vector3d(0.0, 30.0, 0.0);
  EXPECT_FALSE(localization_.setInitialPose(elsewhere));
  EXPECT_TRUE(localization_.status().localized);
  EXPECT_LT(errorAt(first), kMapError_m);
}

TEST_F(LocalizationTest, RefusesKeyframesThatCannotBeUsed) {
  localization_.addKeyframe(walk_->front().keyframe);
  EXPECT_THROW(localization_.addKeyframe(walk_->front().keyframe), std::invalid_argument);
  Keyframe blind = (*walk_)[1].keyframe;
  blind.cloud.reset();
  EXPECT_THROW(localization_.addKeyframe(blind), std::invalid_argument);
  Keyframe sure = (*walk_)[1].keyframe;
  sure.covariance.setZero();
  EXPECT_THROW(localization_.addKeyframe(sure), std::invalid_argument);
  EXPECT_NO_THROW(localization_.addKeyframe((*walk_)[1].keyframe));
}

TEST_F(LocalizationTest, ALongSearchKeepsOnlyWhatIsNew) {
  BackEndConfig config;
  config.localization.max_session_keyframes = 10;
  config.relocation.min_seen_m = 1e3;  // never enough
  Localization searching(*map_, config);
  std::vector<std::weak_ptr<const ObservedPlanes>> planes;
  for (const KeyframeWithTruth& step : *walk_) {
    Keyframe keyframe = step.keyframe;
    keyframe.planes = std::make_shared<const ObservedPlanes>(*keyframe.planes);
    planes.push_back(keyframe.planes);
    searching.addKeyframe(keyframe);
  }
  std::size_t kept = 0;
  for (const auto& each : planes) kept += each.expired() ? 0 : 1;
  EXPECT_LE(kept, 15U);
  EXPECT_GT(planes.size(), 15U);
  EXPECT_FALSE(searching.status().localized);
}

TEST_F(LocalizationTest, ARunLeavesTheMapAsItIsAndTellsWhenItKnewThePlace) {
  LocalizedRun run(*map_, BackEndConfig{});
  for (const KeyframeWithTruth& step : *walk_) {
    ScanReport report;
    report.stamp_s = step.keyframe.stamp_s;
    run.addScan({step.keyframe.stamp_s, step.keyframe.T_odom_base, Matrix6::Identity()}, report);
    run.addKeyframe(step.keyframe, 0.0);
  }
  const RunRecord record = run.record();
  EXPECT_EQ(record.graph, *map_);
  EXPECT_TRUE(record.state.empty());
  EXPECT_EQ(record.odometry.size(), walk_->size());
  ASSERT_TRUE(record.localization);
  EXPECT_TRUE(record.localization->localized);
  EXPECT_EQ(record.localization->relocations, 1);
  EXPECT_EQ(record.localization->losses, 0);
  ASSERT_TRUE(record.localization->first_after_s && record.localization->first_after_m);
  EXPECT_GT(*record.localization->first_after_m, 1.0);
  EXPECT_LT(record.trajectory.size(), walk_->size());
  EXPECT_GT(record.trajectory.front().stamp_s,
            record.odometry.front().stamp_s + *record.localization->first_after_s);
}

}  // namespace
}  // namespace mrpt_sgraphs
