// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sim/simulation.h"
#include "sim/truth.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

SimulationConfig configWith(uint64_t seed) {
  SimulationConfig config;
  config.lidar = lidarNamed("vlp16_sparse");
  config.robot = robotNamed("legged");
  config.seed = seed;
  return config;
}

/// Everything that a run measures.
struct Measured {
  std::vector<ImuSample> imu;
  std::vector<OdometrySample> odometry;
  std::vector<LidarScan> scans;
  std::vector<int64_t> arrivals_ns;
};

Measured runOf(Simulation& simulation) {
  Measured measured;
  MeasurementSink sink;
  sink.imu = [&](const ImuSample& sample) {
    measured.imu.push_back(sample);
    measured.arrivals_ns.push_back(sample.time_ns);
  };
  sink.odometry = [&](const OdometrySample& sample) {
    measured.odometry.push_back(sample);
    measured.arrivals_ns.push_back(sample.time_ns);
  };
  sink.scan = [&](const LidarScan& scan) {
    measured.scans.push_back(scan);
    measured.arrivals_ns.push_back(scan.start_ns + scan.period_ns);
  };
  simulation.run(sink);
  return measured;
}

struct StampedPose {
  double time_s;
  Pose T;
};

std::vector<StampedPose> parseTum(const std::string& text) {
  std::vector<StampedPose> poses;
  std::istringstream lines(text);
  double t, x, y, z, qx, qy, qz, qw;
  while (lines >> t >> x >> y >> z >> qx >> qy >> qz >> qw) {
    StampedPose pose{t - double(kStartOfRun_s), Pose::Identity()};
    pose.T.translation() << x, y, z;
    pose.T.linear() = Eigen::Quaterniond(qw, qx, qy, qz).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

class SmallRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    simulation_ = new Simulation(test::shipped("small"), configWith(1));
    measured_ = new Measured(runOf(*simulation_));
  }
  static void TearDownTestSuite() {
    delete measured_;
    delete simulation_;
  }

  static Simulation* simulation_;
  static Measured* measured_;
};
Simulation* SmallRun::simulation_ = nullptr;
Measured* SmallRun::measured_ = nullptr;

TEST_F(SmallRun, ComesInTimeOrderAtTheRatesOfTheSensors) {
  EXPECT_TRUE(std::is_sorted(measured_->arrivals_ns.begin(), measured_->arrivals_ns.end()));
  const double duration_s = simulation_->duration_s();
  EXPECT_NEAR(double(measured_->imu.size()), 100.0 * duration_s, 2.0);
  EXPECT_NEAR(double(measured_->odometry.size()), 20.0 * duration_s, 2.0);
  EXPECT_NEAR(double(measured_->scans.size()), 10.0 * duration_s, 2.0);
}

TEST_F(SmallRun, TruthHasAPoseForEveryScan) {
  const auto base = parseTum(baseTrajectoryTum(*simulation_));
  const auto lidar = parseTum(lidarTrajectoryTum(*simulation_));
  ASSERT_EQ(base.size(), measured_->scans.size());
  ASSERT_EQ(lidar.size(), measured_->scans.size());
  for (size_t k = 0; k < base.size(); ++k) {
    EXPECT_NEAR(base[k].time_s, 1e-9 * double(measured_->scans[k].start_ns), 1e-6);
    const Pose T_base_lidar = base[k].T.inverse() * lidar[k].T;
    EXPECT_NEAR(local(T_base_lidar, simulation_->T_base_lidar()).norm(), 0.0, 1e-7);
  }
}

TEST_F(SmallRun, GyroscopeAgreesWithTheTruth) {
  const auto base = parseTum(baseTrajectoryTum(*simulation_));
  const ImuNoise noise;
  constexpr size_t kImuPerScan = 10;
  for (size_t k = 0; k + 1 < base.size(); ++k) {
    // The rotation between two scans, and the gyroscope integrated from one to the other.
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (size_t j = k * kImuPerScan; j < (k + 1) * kImuPerScan; ++j) {
      const Eigen::Vector3d mean = 0.5 * (measured_->imu[j].angular_velocity_base +
                                          measured_->imu[j + 1].angular_velocity_base);
      R *= expSO3(0.01 * mean);
    }
    const Eigen::Matrix3d R_true = base[k].T.linear().transpose() * base[k + 1].T.linear();
    const double error_rad = logSO3(R.transpose() * R_true).norm();
    // Bias over 0.1 s, and the trapezoid rule for a gait of 2 Hz.
    EXPECT_LT(error_rad, 0.1 * 5.0 * noise.gyro_bias_rad_s + 1e-3) << "scan " << k;
  }
}

TEST_F(SmallRun, AccelerometerFeelsGravityAtRest) {
  constexpr size_t kAtRest = 100;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (size_t k = 0; k < kAtRest; ++k) mean += measured_->imu[k].acceleration_base / kAtRest;
  EXPECT_NEAR((mean - kGravity_m_s2 * Eigen::Vector3d::UnitZ()).norm(), 0.0, 0.15);
}

TEST_F(SmallRun, OdometryStartsAtItsOriginAndDriftsALittle) {
  const OdometrySample& first = measured_->odometry.front();
  const OdometrySample& last = measured_->odometry.back();
  EXPECT_EQ(first.T_odom_base.translation().norm(), 0.0);
  const Pose T_first_last = simulation_->trajectory().T_map_base(0.0).inverse() *
                            simulation_->trajectory().T_map_base(1e-9 * double(last.time_ns));
  const Pose T_odom = first.T_odom_base.inverse() * last.T_odom_base;
  const double drift_m = (T_odom.translation() - T_first_last.translation()).norm();
  EXPECT_GT(drift_m, 0.001 * last.distance_m);
  EXPECT_LT(drift_m, 0.04 * last.distance_m);
}

TEST_F(SmallRun, SameSeedSameRunOtherSeedOtherNoise) {
  Simulation again(test::shipped("small"), configWith(1));
  Simulation other(test::shipped("small"), configWith(2));
  EXPECT_EQ(lidarTrajectoryTum(again), lidarTrajectoryTum(other));  // the truth has no noise
  const Measured same = runOf(again);
  const Measured different = runOf(other);
  EXPECT_EQ(buildingJson(again), buildingJson(*simulation_));
  const auto pointOf = [](const Measured& m) { return m.scans[100].returns[100].point_lidar; };
  EXPECT_EQ(pointOf(same), pointOf(*measured_));
  EXPECT_NE(pointOf(different), pointOf(*measured_));
  EXPECT_EQ(same.imu[500].acceleration_base, measured_->imu[500].acceleration_base);
  EXPECT_NE(different.imu[500].acceleration_base, measured_->imu[500].acceleration_base);
  EXPECT_EQ(same.odometry[500].T_odom_base.matrix(), measured_->odometry[500].T_odom_base.matrix());
  EXPECT_NE(different.odometry[500].T_odom_base.matrix(),
            measured_->odometry[500].T_odom_base.matrix());
}

/// The building is turned, so that odom and map differ by more than an offset.
class OdometryErrors : public ::testing::Test {
 protected:
  /// The last sample of the whole walk.
  OdometrySample lastWith(const OdometryNoise& noise) const {
    Odometry odometry(trajectory_, 1, noise);
    OdometrySample sample = odometry.next();
    while (1e-9 * double(sample.time_ns) < trajectory_.duration_s() - 0.1) sample = odometry.next();
    return sample;
  }
  Eigen::Vector3d trueOffset(int64_t time_ns) const {
    const Pose T_map_start = trajectory_.T_map_base(0.0);
    const Pose T_map_end = trajectory_.T_map_base(1e-9 * double(time_ns));
    return T_map_start.linear().transpose() * (T_map_end.translation() - T_map_start.translation());
  }

  const OdometryNoise none_{0.0, 0.0, 0.0, 0.0, 0.0};
  const Building building_ = test::buildingFrom("rotation_deg: 70\n" + test::kTwoRooms);
  const Trajectory trajectory_ = walkTour(building_, robotNamed("legged"));
};

TEST_F(OdometryErrors, WithoutThemItIsTheMotionSinceTheStart) {
  const OdometrySample sample = lastWith(none_);
  const Eigen::Matrix3d R_true = trajectory_.T_map_base(0.0).linear().transpose() *
                                 trajectory_.T_map_base(1e-9 * double(sample.time_ns)).linear();
  EXPECT_NEAR((sample.T_odom_base.translation() - trueOffset(sample.time_ns)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(logSO3(R_true.transpose() * sample.T_odom_base.linear()).norm(), 0.0, 1e-9);
}

TEST_F(OdometryErrors, ScaleStretchesTheWay) {
  OdometryNoise noise = none_;
  noise.scale = 0.01;
  const OdometrySample sample = lastWith(noise);
  const double ratio = sample.T_odom_base.translation().norm() / trueOffset(sample.time_ns).norm();
  EXPECT_NEAR(std::abs(ratio - 1.0), noise.scale, 1e-9);
}

TEST_F(OdometryErrors, BiasTurnsTheHeadingSteadily) {
  OdometryNoise noise = none_;
  noise.yaw_rate_bias_rad_s = 1e-3;
  const OdometrySample sample = lastWith(noise);
  const Eigen::Matrix3d R_error =
      lastWith(none_).T_odom_base.linear().transpose() * sample.T_odom_base.linear();
  EXPECT_NEAR(logSO3(R_error).norm(), 1e-3 * 1e-9 * double(sample.time_ns), 1e-9);
}

TEST(Simulation, LidarDoesNotChangeTheOtherSensors) {
  SimulationConfig config = configWith(1);
  config.max_duration_s = 3.0;
  Simulation sparse(test::shipped("small"), config);
  config.lidar = lidarNamed("vlp16");
  Simulation full(test::shipped("small"), config);
  EXPECT_EQ(runOf(sparse).imu.back().acceleration_base, runOf(full).imu.back().acceleration_base);
}

TEST(Simulation, DurationCutsTheTour) {
  SimulationConfig config = configWith(1);
  config.max_duration_s = 2.05;
  Simulation simulation(test::shipped("small"), config);
  const Measured measured = runOf(simulation);
  EXPECT_EQ(measured.scans.size(), 20U);  // whole sweeps only
  EXPECT_EQ(measured.imu.size(), 206U);
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
