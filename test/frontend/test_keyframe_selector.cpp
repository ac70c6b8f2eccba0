// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/keyframe_selector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrpt_sgraphs {
namespace {

Pose planar(double x, double y, double yaw_rad) {
  Pose T = Pose::Identity();
  T.translation() << x, y, 0.0;
  T.linear() = expSO3({0.0, 0.0, yaw_rad});
  return T;
}

Matrix6 covarianceOf(double sigma_m, double sigma_rad) {
  Tangent variance;
  variance << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return variance.asDiagonal();
}

/// What withFloor() adds after a way.
Matrix6 floorAfter(double way_m, const KeyframeConfig& config) {
  return covarianceOf(config.sigma_floor_m + config.sigma_m_per_m * way_m,
                      config.sigma_floor_rad + config.sigma_rad_per_m * way_m);
}

class KeyframeSelectorTest : public ::testing::Test {
 protected:
  std::optional<Keyframe> process(double stamp_s, const Pose& T_odom_base,
                                  const Matrix6& covariance = Matrix6::Zero()) {
    return selector_.process({stamp_s, T_odom_base, covariance}, cloud_);
  }

  KeyframeConfig config_;
  KeyframeSelector selector_{config_};
  Cloud cloud_;
};

TEST_F(KeyframeSelectorTest, TakesTheFirstScan) {
  const auto keyframe = process(12.0, planar(3.0, 1.0, 0.5));
  ASSERT_TRUE(keyframe);
  EXPECT_EQ(keyframe->stamp_s, 12.0);
  EXPECT_TRUE(keyframe->T_odom_base.isApprox(planar(3.0, 1.0, 0.5)));
}

TEST_F(KeyframeSelectorTest, TakesOneEveryMetreOfAStraightWay) {
  std::vector<double> at_m;
  for (int k = 0; k <= 100; ++k) {
    const double x = 0.0625 * k;
    if (process(0.1 * k, planar(x, 0.0, 0.0))) at_m.push_back(x);
  }
  EXPECT_EQ(at_m, (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

TEST_F(KeyframeSelectorTest, MeasuresDistanceAsTheCrowFlies) {
  EXPECT_TRUE(process(0.0, planar(0.0, 0.0, 0.0)));
  for (int k = 1; k <= 90; ++k) {  // to and fro on 0.6 m
    const double x = 0.6 * std::abs(std::sin(0.1 * k));
    EXPECT_FALSE(process(0.1 * k, planar(x, 0.0, 0.0))) << k;
  }
}

TEST_F(KeyframeSelectorTest, TakesOneForEveryTurn) {
  int keyframes = 0;
  for (int k = 0; k <= 360; ++k) {  // on the spot, once round
    if (process(0.01 * k, planar(0.0, 0.0, k * M_PI / 180.0))) ++keyframes;
  }
  EXPECT_EQ(keyframes, 1 + static_cast<int>(360.0 / std::ceil(0.7 * 180.0 / M_PI)));
}

TEST_F(KeyframeSelectorTest, TakesOneAfterAWhileIfTheRobotMovedAtAll) {
  EXPECT_TRUE(process(0.0, planar(0.0, 0.0, 0.0)));
  EXPECT_FALSE(process(9.9, planar(0.2, 0.0, 0.0)));
  EXPECT_TRUE(process(10.0, planar(0.2, 0.0, 0.0)));
  EXPECT_FALSE(process(20.0, planar(0.25, 0.0, 0.0)));
  EXPECT_TRUE(process(20.1, planar(0.31, 0.0, 0.0)));
}

TEST_F(KeyframeSelectorTest, ARobotThatStandsAddsNothingInTenMinutes) {
  std::mt19937 generator(1);
  std::normal_distribution<double> jitter(0.0, 0.005);
  EXPECT_TRUE(process(0.0, planar(0.0, 0.0, 0.0)));
  for (int k = 1; k <= 6000; ++k) {
    const Pose T = planar(jitter(generator), jitter(generator), 0.2 * jitter(generator));
    ASSERT_FALSE(process(0.1 * k, T, covarianceOf(0.002, 0.0005))) << k;
  }
}

TEST_F(KeyframeSelectorTest, CovarianceIsThatOfManySuchWays) {
  // a curve of 30 scans whose motions are noisy: what the end says, run by run
  constexpr int kScans = 30;
  constexpr int kRuns = 4000;
  const Pose step = planar(0.04, 0.01, 0.015);
  const Matrix6 noise = covarianceOf(0.004, 0.002);
  std::mt19937 generator(7);
  std::normal_distribution<double> unit(0.0, 1.0);
  const Matrix6 root = noise.cwiseSqrt();

  Pose T_true = Pose::Identity();
  std::vector<Pose> ends(kRuns, Pose::Identity());
  std::optional<Keyframe> keyframe = process(0.0, T_true);
  for (int k = 1; k <= kScans; ++k) {
    ASSERT_TRUE(k == 1 || !keyframe);
    T_true = T_true * step;
    keyframe = process(0.1 * k, T_true, noise);
    for (Pose& T : ends) {
      Tangent error;
      for (int row = 0; row < 6; ++row) error[row] = unit(generator);
      T = T * step * expPose(root * error);
    }
    if (keyframe) {
      EXPECT_GT(k, 20);
      break;
    }
  }
  ASSERT_TRUE(keyframe);
  Matrix6 sampled = Matrix6::Zero();
  for (const Pose& T : ends) {
    const Tangent error = local(T_true, T);
    sampled += error * error.transpose() / kRuns;
  }
  const double way_m = T_true.translation().norm();
  EXPECT_NEAR(way_m, 1.0, 0.05);
  const Matrix6 added_up = keyframe->covariance - floorAfter(1.03, config_);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double size = std::sqrt(sampled(row, row) * sampled(column, column));
      EXPECT_NEAR(added_up(row, column), sampled(row, column), 0.08 * size) << row << column;
    }
  }
}

TEST_F(KeyframeSelectorTest, CovarianceHasAFloorThatGrowsWithTheWay) {
  process(0.0, planar(0.0, 0.0, 0.0));
  const auto straight = process(1.0, planar(1.5, 0.0, 0.0));
  ASSERT_TRUE(straight);
  EXPECT_TRUE(straight->covariance.isApprox(floorAfter(1.5, config_), 1e-12));

  process(2.0, planar(1.5, 0.8, 0.0));  // a detour to the same distance
  const auto detour = process(3.0, planar(3.0, 0.0, 0.0));
  ASSERT_TRUE(detour);
  EXPECT_TRUE(detour->covariance.isApprox(floorAfter(0.8 + std::hypot(1.5, 0.8), config_), 1e-12));

  const auto turned = process(4.0, planar(3.0, 0.0, 1.0));  // no way at all
  ASSERT_TRUE(turned);
  EXPECT_TRUE(turned->covariance.isApprox(floorAfter(0.0, config_), 1e-12));
}

TEST_F(KeyframeSelectorTest, CovarianceBeginsAnewAtEveryKeyframe) {
  const Matrix6 noise = covarianceOf(0.01, 0.005);
  process(0.0, planar(0.0, 0.0, 0.0), noise);
  const auto first = process(1.0, planar(1.0, 0.0, 0.0), noise);
  const auto second = process(2.0, planar(2.0, 0.0, 0.0), noise);
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(first->covariance.isApprox(second->covariance, 1e-12));
  EXPECT_TRUE(first->covariance.isApprox(noise + floorAfter(1.0, config_), 1e-12));
}

TEST_F(KeyframeSelectorTest, KeepsAThinCloudWithItsHeader) {
  cloud_.header.stamp = 77;
  cloud_.header.frame_id = "base_link";
  cloud_.sensor_origin_ << 0.1F, 0.0F, 0.4F, 0.0F;
  for (int k = 0; k < 1000; ++k) {
    Point point;
    point.x = 0.001F * static_cast<float>(k);
    cloud_.push_back(point);
  }
  const auto keyframe = process(0.0, planar(0.0, 0.0, 0.0));
  ASSERT_TRUE(keyframe);
  EXPECT_EQ(keyframe->cloud->size(), static_cast<std::size_t>(std::ceil(1.0 / 0.08)));
  EXPECT_EQ(keyframe->cloud->header.stamp, 77U);
  EXPECT_EQ(keyframe->cloud->header.frame_id, "base_link");
  EXPECT_EQ(keyframe->cloud->sensor_origin_, cloud_.sensor_origin_);
}

TEST_F(KeyframeSelectorTest, AfterAResetTheNextScanIsTheFirst) {
  process(100.0, planar(0.0, 0.0, 0.0));
  EXPECT_FALSE(process(100.1, planar(0.1, 0.0, 0.0), covarianceOf(1.0, 1.0)));
  selector_.reset();
  const auto keyframe = process(5.0, planar(0.1, 0.0, 0.0));
  ASSERT_TRUE(keyframe);
  EXPECT_TRUE(keyframe->covariance.isApprox(floorAfter(0.0, config_), 1e-12));
}

}  // namespace
}  // namespace mrpt_sgraphs
