// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/odometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSameStamp_s = 1e-3;

double ateOf(const Trajectory& truth, const Trajectory& run) {
  return evaluateTrajectory(truth, run, kSameStamp_s).ate_m.rmse;
}

/// The first scans of a walk, or all of it, through odometry.
struct Play {
  bool with_times = true;
  bool with_imu = false;
  bool with_odom = false;
  std::function<bool(std::size_t scan)> skips = [](std::size_t) { return false; };
  std::size_t scans = 100000;
};

std::vector<OdometryResult> play(const test::SimulatedRun& run, const Play& how,
                                 Odometry* odometry) {
  constexpr double kSweep_s = 0.1;
  std::vector<OdometryResult> results;
  std::size_t imu = 0;
  std::size_t odom = 0;
  for (std::size_t k = 0; k < std::min(how.scans, run.scans.size()); ++k) {
    const double until_s = run.truth[k].stamp_s + 1.1 * kSweep_s;
    for (; imu < run.imu.size() && run.imu[imu].stamp_s < until_s; ++imu) {
      if (how.with_imu) odometry->addImu(run.imu[imu]);
    }
    for (; odom < run.odom.size() && run.odom[odom].stamp_s < until_s; ++odom) {
      if (how.with_odom) odometry->addOdom(run.odom[odom]);
    }
    if (how.skips(k)) continue;
    const Cloud::Ptr cloud = run.cloud(k);
    const auto result = odometry->process(how.with_times ? *cloud : *test::withoutTimes(*cloud));
    EXPECT_TRUE(result) << "scan " << k;
    if (result) results.push_back(*result);
  }
  return results;
}

std::vector<OdometryResult> play(const test::SimulatedRun& run, const Play& how) {
  Odometry odometry{OdometryConfig{}};
  return play(run, how, &odometry);
}

Trajectory trajectoryOf(const std::vector<OdometryResult>& results) {
  Trajectory trajectory;
  for (const OdometryResult& result : results) {
    trajectory.push_back({result.stamp_s, result.T_odom_base});
  }
  return trajectory;
}

void expectIdentical(const std::vector<OdometryResult>& a, const std::vector<OdometryResult>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    SCOPED_TRACE(k);
    ASSERT_EQ(a[k].stamp_s, b[k].stamp_s);
    ASSERT_EQ(a[k].T_odom_base.matrix(), b[k].T_odom_base.matrix());
    ASSERT_EQ(a[k].velocity_base, b[k].velocity_base);
    ASSERT_EQ(a[k].covariance, b[k].covariance);
    ASSERT_EQ(a[k].inlier_ratio, b[k].inlier_ratio);
  }
}

/// The tour of the small building, walked once for all tests.
class OdometryInABuilding : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = new test::SimulatedRun(test::simulatedRun(sim::test::shipped("small"), "vlp16_sparse"));
  }
  static void TearDownTestSuite() { delete run_; }

  static const test::SimulatedRun* run_;
};
const test::SimulatedRun* OdometryInABuilding::run_ = nullptr;

TEST_F(OdometryInABuilding, FollowsTheWalkToTheCentimetre) {
  const auto results = play(*run_, {});
  ASSERT_EQ(results.size(), run_->scans.size());
  EXPECT_LT(ateOf(run_->truth, trajectoryOf(results)), 0.02);
  for (const OdometryResult& result : results) {
    ASSERT_TRUE(result.registered) << result.stamp_s;
    ASSERT_EQ(isOfOneMoment(*result.deskewed), &result != &results.front()) << result.stamp_s;
    ASSERT_EQ(result.problem, "");
    ASSERT_TRUE(result.T_odom_base.linear().isUnitary(1e-9));
    ASSERT_TRUE(result.covariance.isApprox(result.covariance.transpose(), 1e-6));
    ASSERT_GT(result.covariance.diagonal().minCoeff(), 0.0);
    ASSERT_LT(result.covariance.diagonal().maxCoeff(), 0.01);
  }
}

/// The first scan is as distorted as any other.
TEST_F(OdometryInABuilding, StartsWhileTheRobotMoves) {
  for (const std::size_t start : {60, 95, 130, 165, 200}) {
    SCOPED_TRACE(start);
    Play how;
    how.skips = [start](std::size_t scan) { return scan < start; };
    how.scans = start + 60;
    const auto results = play(*run_, how);
    ASSERT_EQ(results.size(), 60U);
    EXPECT_LT(ateOf(run_->truth, trajectoryOf(results)), 0.015);
    const auto moved = local(results[0].T_odom_base, results[1].T_odom_base);
    EXPECT_GT(moved.norm(), 0.02) << "it stands";
  }
}

TEST_F(OdometryInABuilding, FollowsItWithoutTimes) {
  const Trajectory poses = trajectoryOf(play(*run_, {false}));
  EXPECT_LT(ateOf(run_->truth, poses), 0.05);
  // the pose of a scan that is not straightened is that of the middle of its sweep
  Trajectory truth;
  for (std::size_t k = 0; k + 1 < run_->truth.size(); ++k) {
    truth.push_back({run_->truth[k].stamp_s, interpolate(run_->truth[k].T_world_body,
                                                         run_->truth[k + 1].T_world_body, 0.5)});
  }
  EXPECT_LT(ateOf(truth, poses), 0.03);
}

TEST_F(OdometryInABuilding, GainsByAGyroscope) {
  const double alone_m = ateOf(run_->truth, trajectoryOf(play(*run_, {})));
  const double with_imu_m = ateOf(run_->truth, trajectoryOf(play(*run_, {true, true})));
  EXPECT_LT(with_imu_m, 1.2 * alone_m);
}

TEST_F(OdometryInABuilding, LosesNothingByTheRobotsOwnOdometry) {
  const double alone_m = ateOf(run_->truth, trajectoryOf(play(*run_, {})));
  const double with_odom_m = ateOf(run_->truth, trajectoryOf(play(*run_, {true, false, true})));
  EXPECT_LT(with_odom_m, 1.2 * alone_m);
}

TEST_F(OdometryInABuilding, EstimatesTheVelocity) {
  const auto results = play(*run_, {});
  double sum = 0.0;
  for (std::size_t k = 1; k < results.size(); ++k) {
    // of the base in its own frame, from the truth
    const Pose T_before_after =
        run_->truth[k - 1].T_world_body.inverse() * run_->truth[k].T_world_body;
    const double dt_s = run_->truth[k].stamp_s - run_->truth[k - 1].stamp_s;
    sum += (results[k - 1].velocity_base.head<3>() - T_before_after.translation() / dt_s)
               .squaredNorm();
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(results.size())), 0.15);
}

/// Leaves out two seconds from each of these scans on.
std::function<bool(std::size_t)> jumpsAt(const std::vector<std::size_t>& starts) {
  constexpr std::size_t kJump = 20;
  return [starts](std::size_t k) {
    return std::any_of(starts.begin(), starts.end(), [&](std::size_t start) {
      return k >= start && k < start + kJump;
    });
  };
}

TEST_F(OdometryInABuilding, RecoversFromJumpsWhereItHasBeen) {
  const auto results = play(*run_, {true, false, false, jumpsAt({100, 180, 260, 350})});
  ASSERT_EQ(results.size(), run_->scans.size() - 80);
  EXPECT_LT(ateOf(run_->truth, trajectoryOf(results)), 0.02);
  EXPECT_TRUE(results.back().registered);
}

TEST_F(OdometryInABuilding, RecoversFromJumpsIntoTheUnknownByTheRobotsOwnOdometry) {
  const auto results = play(*run_, {true, false, true, jumpsAt({40, 90, 150, 210, 300})});
  EXPECT_LT(ateOf(run_->truth, trajectoryOf(results)), 0.02);
  EXPECT_TRUE(results.back().registered);
}

TEST_F(OdometryInABuilding, SameInputSameOutput) {
  const Play how{true, true, true, [](std::size_t) { return false; }, 120};
  expectIdentical(play(*run_, how), play(*run_, how));
}

TEST_F(OdometryInABuilding, AfterAResetItIsAsNew) {
  const Play how{true, true, true, [](std::size_t) { return false; }, 80};
  Odometry odometry{OdometryConfig{}};
  const auto first = play(*run_, how, &odometry);
  odometry.reset();
  expectIdentical(first, play(*run_, how, &odometry));
}

TEST_F(OdometryInABuilding, RefusesScansThatAreNotNewerOrEmpty) {
  Odometry odometry{OdometryConfig{}};
  EXPECT_FALSE(odometry.process(Cloud{})) << "empty, the very first";
  std::vector<OdometryResult> results;
  for (std::size_t k = 0; k < 30; ++k) {
    results.push_back(*odometry.process(*run_->cloud(k)));
    EXPECT_FALSE(odometry.process(*run_->cloud(k))) << "once more";
    EXPECT_FALSE(odometry.process(*run_->cloud(k / 2))) << "an earlier one";
    Cloud empty;
    empty.header.stamp = run_->cloud(k)->header.stamp + 1000;
    EXPECT_FALSE(odometry.process(empty));
  }
  // as if they had never come
  expectIdentical(results, play(*run_, {true, false, false, [](std::size_t) { return false; }, 30}));
}

TEST_F(OdometryInABuilding, SaysSoWhenAScanDoesNotFit) {
  Odometry odometry{OdometryConfig{}};
  play(*run_, {true, false, false, [](std::size_t) { return false; }, 50}, &odometry);
  Cloud::Ptr elsewhere = run_->cloud(50);
  for (Point& point : *elsewhere) point.getVector3fMap() *= 5.0F;
  const auto lost = odometry.process(*elsewhere);
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->registered);
  EXPECT_NE(lost->problem, "");
  EXPECT_EQ(lost->degenerate_directions, 6);
  EXPECT_TRUE(lost->T_odom_base.matrix().allFinite());
  for (std::size_t k = 51; k < 60; ++k) {
    const auto found = odometry.process(*run_->cloud(k));
    EXPECT_TRUE(found->registered) << "the scans after it fit again: " << k;
  }
}

/// A robot in a room, seen at will.
class OdometryInARoom : public ::testing::Test {
 protected:
  const test::ScanStage stage_{sim::test::shipped("small"), sim::lidarNamed("vlp16_sparse")};
};

TEST_F(OdometryInARoom, StandsStill) {
  constexpr std::uint64_t kScans = 200;
  constexpr std::uint64_t kMean = 20;  // two seconds: one scan alone scatters by some millimetres
  Odometry odometry{OdometryConfig{}};
  Pose T_odom_first = Pose::Identity();
  Tangent at_start = Tangent::Zero();
  Tangent at_end = Tangent::Zero();
  for (std::uint64_t k = 1; k <= kScans; ++k) {
    const auto result = odometry.process(*stage_.scan({{2.2, 4.2}, 0.7}, k).cloud);
    ASSERT_TRUE(result);
    if (k == 1) T_odom_first = result->T_odom_base;
    const Tangent motion = local(T_odom_first, result->T_odom_base);
    ASSERT_LT(motion.head<3>().norm(), 0.02) << "scan " << k;
    ASSERT_LT(motion.tail<3>().norm(), 0.015) << "scan " << k;
    if (k <= kMean) at_start += motion / kMean;
    if (k > kScans - kMean) at_end += motion / kMean;
  }
  EXPECT_LT((at_end - at_start).head<3>().norm(), 0.005);
  EXPECT_LT((at_end - at_start).tail<3>().norm(), 0.002);
}

TEST_F(OdometryInARoom, StraightensSweeps) {
  // from rest to 0.7 m/s and 0.8 rad/s in two seconds
  constexpr double kPeriod_s = 0.1;
  constexpr std::uint64_t kRest = 5;
  constexpr std::uint64_t kScans = 30;
  Odometry odometry{OdometryConfig{}};
  test::SteadyMotion motion;
  motion.place_map << 1.5, 3.5;
  for (std::uint64_t k = 1; k <= kScans; ++k) {
    const test::PlacedScan scan = stage_.scan(motion, k);
    const auto result = odometry.process(*scan.cloud);
    ASSERT_TRUE(result);
    ASSERT_EQ(result->deskewed->size(), scan.cloud->size());
    EXPECT_EQ(result->deskewed->header.stamp, scan.cloud->header.stamp);
    EXPECT_EQ(result->deskewed->sensor_origin_, scan.cloud->sensor_origin_);

    const Eigen::Vector3d velocity_map(motion.velocity_map.x(), motion.velocity_map.y(), 0.0);
    const Eigen::Vector3d velocity_base = scan.T_map_base.linear().transpose() * velocity_map;
    double squares = 0.0;
    double squares_as_measured = 0.0;
    for (std::size_t i = 0; i < scan.cloud->size(); ++i) {
      const Point& measured = (*scan.cloud)[i];
      const Eigen::Vector3d p = measured.getVector3fMap().cast<double>();
      const Eigen::Vector3d straight =
          expSO3({0.0, 0.0, measured.time * motion.turning_rad_s}) * p +
          measured.time * velocity_base;
      const Eigen::Vector3d ours = (*result->deskewed)[i].getVector3fMap().cast<double>();
      squares += (ours - straight).squaredNorm();
      squares_as_measured += (p - straight).squaredNorm();
    }
    const auto points = static_cast<double>(scan.cloud->size());
    EXPECT_LT(std::sqrt(squares / points), 0.02) << "scan " << k;
    EXPECT_TRUE(k < kScans || squares < 0.1 * squares_as_measured);

    motion.place_map += kPeriod_s * motion.velocity_map;
    motion.yaw_rad += kPeriod_s * motion.turning_rad_s;
    if (k > kRest && motion.turning_rad_s < 0.8) {
      motion.velocity_map += Eigen::Vector2d(0.03, 0.02);
      motion.turning_rad_s += 0.04;
    }
  }
}

TEST_F(OdometryInARoom, StartsLevelByGravity) {
  // the base is tilted, and the IMU says so
  const Eigen::Matrix3d R_level_base = expSO3({0.2, -0.3, 0.0});
  Cloud::Ptr scan = stage_.scan({{2.2, 4.2}}).cloud;
  const Pose T_base_level = Pose(R_level_base.transpose());
  for (Point& p : *scan) p.getVector3fMap() = T_base_level.cast<float>() * p.getVector3fMap();
  Odometry odometry{OdometryConfig{}};
  for (int k = -50; k <= 15; ++k) {
    odometry.addImu({stampOf(*scan) + 0.01 * k, Eigen::Vector3d::Zero(),
                     R_level_base.transpose() * Eigen::Vector3d(0.0, 0.0, 9.81)});
  }
  const auto result = odometry.process(*scan);
  EXPECT_LT(logSO3(result->T_odom_base.linear().transpose() * R_level_base).norm(), 1e-6);
  EXPECT_TRUE(result->T_odom_base.translation().isZero(0.0));
}

}  // namespace
}  // namespace mrpt_sgraphs
