// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

Matrix12 covarianceOf(const MotionPrior& prior) { return prior.information.inverse(); }

/// The same motion with another pose and velocity.
MotionState retracted(MotionState state, const Vector12& delta) {
  state.mean.T_map_base = retract(state.mean.T_map_base, delta.head<6>());
  state.mean.velocity_base += delta.tail<6>();
  return state;
}

class MotionModelTest : public ::testing::Test {
 protected:
  MotionModelTest() {
    last_ = startingMotion(100.0, random_.pose());
    last_.mean.velocity_base << 0.8, 0.1, -0.05, 0.02, -0.03, 0.6;
  }

  MotionPrior predict(const MotionState& last, double dt_s, bool gyro_in_sweep = false) const {
    return predictMotion(last, last.stamp_s + dt_s, gyro_in_sweep, imu_, odom_, {});
  }

  test::RandomGeometry random_{4, 20.0};
  MotionState last_;
  ImuBuffer imu_;
  OdomBuffer odom_;
};

TEST_F(MotionModelTest, GoesOnAsBefore) {
  for (const double dt_s : {0.1, 0.5, 1.0}) {
    const MovingPose next = predict(last_, dt_s).mean;
    const Pose T_last_next = last_.mean.T_map_base.inverse() * next.T_map_base;
    EXPECT_LT((T_last_next.translation() - dt_s * last_.mean.velocity_base.head<3>()).norm(), 1e-9);
    EXPECT_LT((logSO3(T_last_next.linear()) - dt_s * last_.mean.velocity_base.tail<3>()).norm(),
              1e-9);
    // the same velocity over ground, seen from the robot that has turned
    EXPECT_LT((T_last_next.linear() * next.velocity_base.head<3>() -
               last_.mean.velocity_base.head<3>())
                  .norm(),
              1e-9);
  }
}

TEST_F(MotionModelTest, DoesNotDependOnWhereTheMapIs) {
  const Pose T_other_map = random_.pose();
  MotionState elsewhere = last_;
  elsewhere.mean.T_map_base = T_other_map * last_.mean.T_map_base;
  const MotionPrior here = predict(last_, 0.3);
  const MotionPrior there = predict(elsewhere, 0.3);
  EXPECT_LT(local(T_other_map * here.mean.T_map_base, there.mean.T_map_base).norm(), 1e-9);
  EXPECT_TRUE(there.information.isApprox(here.information, 1e-6));
}

TEST_F(MotionModelTest, IsLessSureTheFartherAhead) {
  Tangent before = Tangent::Zero();
  for (const double dt_s : {0.05, 0.1, 0.2, 0.5, 1.0, 3.0}) {
    const MotionPrior prior = predict(last_, dt_s);
    EXPECT_TRUE(prior.information.isApprox(prior.information.transpose(), 1e-6));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix12>(prior.information).eigenvalues()[0], 0.0);
    const Tangent variance = covarianceOfPose(prior).diagonal();
    EXPECT_GT((variance - before).minCoeff(), 0.0) << dt_s;
    before = variance;
  }
}

TEST_F(MotionModelTest, IsSurerOfWhatTheLastSweepHasSeen) {
  MotionState swept = last_;
  swept.seen_until_s = swept.stamp_s + 0.1;
  const Matrix12 blind = covarianceOf(predict(last_, 0.1));
  const Matrix12 seen = covarianceOf(predict(swept, 0.1));
  EXPECT_LT(seen(0, 0), blind(0, 0));
  EXPECT_LT(seen(5, 5), blind(5, 5));
}

TEST_F(MotionModelTest, CarriesUncertaintyOfPoseAlongAsThePoseMoves) {
  constexpr double kDt_s = 0.2;
  MotionState certain = last_;
  certain.covariance.setZero();
  const Matrix12 noise = covarianceOf(predict(certain, kDt_s));
  const MotionPrior mean = predict(certain, kDt_s);
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(k);
    constexpr double kSigma = 0.1;
    MotionState uncertain = certain;
    uncertain.covariance(k, k) = kSigma * kSigma;
    const Matrix6 carried =
        (covarianceOf(predict(uncertain, kDt_s)) - noise).topLeftCorner<6, 6>();
    // by central differences
    constexpr double kStep = 1e-5;
    const Vector12 delta = kStep * Vector12::Unit(k);
    const Pose ahead = predict(retracted(certain, delta), kDt_s).mean.T_map_base;
    const Pose behind = predict(retracted(certain, -delta), kDt_s).mean.T_map_base;
    const Tangent derivative =
        (local(mean.mean.T_map_base, ahead) - local(mean.mean.T_map_base, behind)) / (2.0 * kStep);
    const Matrix6 expected = kSigma * kSigma * derivative * derivative.transpose();
    EXPECT_LT((carried - expected).norm(), 0.1 * expected.norm() + 1e-9);
  }
}

TEST_F(MotionModelTest, TakesTurningFromTheGyroscope) {
  const Eigen::Vector3d rate(0.1, -0.2, 1.2);
  for (int k = -20; k <= 40; ++k) {
    imu_.add({last_.stamp_s + 0.01 * k, rate, {0.0, 0.0, 9.81}});
  }
  const MotionPrior prior = predict(last_, 0.2, true);
  const Pose T_last_next = last_.mean.T_map_base.inverse() * prior.mean.T_map_base;
  EXPECT_LT((logSO3(T_last_next.linear()) - 0.2 * rate).norm(), 1e-6);
  EXPECT_TRUE(prior.mean.velocity_base.tail<3>().isZero(0.0)) << "within the sweep it is known";
  const Matrix12 covariance = covarianceOf(prior);
  EXPECT_LT(std::sqrt(covariance(5, 5)), 0.05);
  EXPECT_LT(std::sqrt(covariance(11, 11)), 0.05);
}

TEST_F(MotionModelTest, BelievesTheRobotsOdometryMoreThanAGuess) {
  // pushed: nothing like the velocity so far
  Tangent pushed;
  pushed << -0.4, 0.3, 0.0, 0.0, 0.0, -0.5;
  const Pose T_own_last = random_.pose();
  odom_.add({last_.stamp_s, T_own_last});
  odom_.add({last_.stamp_s + 0.5, T_own_last * expPose(pushed)});
  const MotionPrior prior = predict(last_, 0.5);
  const Pose T_last_next = last_.mean.T_map_base.inverse() * prior.mean.T_map_base;
  EXPECT_LT((logPose(T_last_next) - pushed).head<3>().norm(), 0.1);
  EXPECT_LT((logPose(T_last_next) - pushed).tail<3>().norm(), 0.1);
  OdomBuffer none;
  const Matrix12 without = covarianceOf(
      predictMotion(last_, last_.stamp_s + 0.5, false, imu_, none, MotionModelConfig{}));
  EXPECT_LT(covarianceOf(prior)(0, 0), 0.1 * without(0, 0));
}

TEST_F(MotionModelTest, KnowsLittleWhenItIsLost) {
  const MotionPrior lost = ignorantAround(last_.mean);
  EXPECT_EQ(lost.mean.T_map_base.matrix(), last_.mean.T_map_base.matrix());
  const Matrix6 covariance = covarianceOfPose(lost);
  EXPECT_GE(std::sqrt(covariance(0, 0)), 0.5);
  EXPECT_GE(std::sqrt(covariance(5, 5)), 0.3);
}

}  // namespace
}  // namespace mrpt_sgraphs
