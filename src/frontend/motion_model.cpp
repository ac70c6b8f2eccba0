// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/motion_model.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace mrpt_sgraphs {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// The end of one sweep and the start of the next are known to fit this well.
constexpr double kSeam_m = 0.005;
constexpr double kSeam_rad = 0.003;
/// With a gyroscope the turning within a scan is known up to its bias and noise.
constexpr double kGyro_rad_s = 0.02;
constexpr double kGyroTurn_rad = 0.003;  ///< and that between two scans.
/// Odometry of wheels or legs takes a turn wrong by this share.
constexpr double kOdomTurnError = 0.1;
/// A robot that starts may already be moving.
constexpr double kFirstSpeed_m_s = 1.0;
constexpr double kFirstTurn_rad_s = 1.0;
constexpr double kLost_m = 1.0;
constexpr double kLost_rad = 0.5;

/// Of a vector [linear; angular] with these standard deviations.
Matrix6 covarianceOf(double linear, double angular) {
  Tangent variance;
  variance << Eigen::Vector3d::Constant(linear * linear),
      Eigen::Vector3d::Constant(angular * angular);
  return variance.asDiagonal();
}

Matrix12 inverse(const Matrix12& matrix) { return matrix.ldlt().solve(Matrix12::Identity()); }

struct Noise {
  double acceleration;  ///< [m/s^2 or rad/s^2]
  double seam;          ///< [m or rad]
};

/// Adds to the covariance, at rows `at` and 6 + `at`, what a constant velocity may be wrong by after
/// dt_s. The velocity changes all the time; it is taken to change at once, so that the pose is off by
/// the change for the part that the last sweep did not see. (Were it taken to change steadily, each
/// displacement would set the velocity to twice its mean, and so swing.)
void addNoise(const Noise& noise, int at, double dt_s, double unseen_s, Matrix12* covariance) {
  const double change = noise.acceleration * dt_s;
  const double drift = change * unseen_s;
  const double pose = noise.seam * noise.seam + drift * drift;
  const double cross = drift * change;
  for (int k = at; k < at + 3; ++k) {
    (*covariance)(k, k) += pose;
    (*covariance)(k, 6 + k) += cross;
    (*covariance)(6 + k, k) += cross;
    (*covariance)(6 + k, 6 + k) += change * change;
  }
}

/// @param T_last_now  The motion since the last scan, as the robot's odometry has it.
void fuseOdomIn(const Pose& T_odom_last, const Pose& T_last_now, const MotionModelConfig& config,
                MotionPrior* prior) {
  const double turn_rad = logSO3(T_last_now.linear()).norm();
  const double way_m = T_last_now.translation().norm() + turn_rad;
  const Matrix6 information =
      covarianceOf(kSeam_m + config.odom_in_sigma_m_per_m * way_m,
                   kSeam_rad + config.odom_in_sigma_rad_per_m * way_m + kOdomTurnError * turn_rad)
          .inverse();
  prior->information.topLeftCorner<6, 6>() += information;
  Vector12 pull = Vector12::Zero();
  pull.head<6>() = information * local(prior->mean.T_map_base, T_odom_last * T_last_now);
  const Vector12 step = prior->information.ldlt().solve(pull);
  prior->mean.T_map_base = retract(prior->mean.T_map_base, step.head<6>());
  prior->mean.velocity_base += step.tail<6>();
}

}  // namespace

MotionState startingMotion(double stamp_s, const Pose& T_odom_base) {
  MotionState state;
  state.stamp_s = stamp_s;
  state.seen_until_s = stamp_s;
  state.mean.T_map_base = T_odom_base;
  state.covariance.topLeftCorner<6, 6>() = covarianceOf(kSeam_m, kSeam_rad);
  state.covariance.bottomRightCorner<6, 6>() = covarianceOf(kFirstSpeed_m_s, kFirstTurn_rad_s);
  return state;
}

MotionPrior predictMotion(const MotionState& last, double stamp_s, bool gyro_in_sweep,
                          const ImuBuffer& imu, const OdomBuffer& odom_in,
                          const MotionModelConfig& config) {
  const double dt_s = stamp_s - last.stamp_s;
  const double unseen_s = std::clamp(stamp_s - last.seen_until_s, 0.0, dt_s);
  const auto R_gyro = imu.rotation(last.stamp_s, stamp_s);
  const auto last_linear = last.mean.velocity_base.head<3>();
  const auto last_angular = last.mean.velocity_base.tail<3>();

  Pose T_last_now = Pose::Identity();
  T_last_now.translation() = dt_s * last_linear;
  T_last_now.linear() = R_gyro ? *R_gyro : expSO3(dt_s * last_angular);
  const Eigen::Matrix3d R_now_last = T_last_now.linear().transpose();

  MotionPrior prior;
  prior.mean.T_map_base = last.mean.T_map_base * T_last_now;
  prior.mean.velocity_base << R_now_last * last_linear, last_angular;

  // the last covariance, carried along
  Matrix12 F = Matrix12::Zero();
  F.topLeftCorner<6, 6>() = adjointOfInverse(T_last_now);
  F.block<3, 3>(0, 6) = dt_s * R_now_last;
  F.block<3, 3>(3, 9) = (R_gyro ? 0.0 : dt_s) * Eigen::Matrix3d::Identity();
  F.block<3, 3>(6, 6) = R_now_last;
  F.block<3, 3>(9, 9).setIdentity();
  Matrix12 covariance = F * last.covariance * F.transpose();
  addNoise({config.max_acceleration_m_s2, kSeam_m}, 0, dt_s, unseen_s, &covariance);
  if (R_gyro) {
    const double sigma_rad = kGyroTurn_rad + kGyro_rad_s * dt_s;
    covariance.block<3, 3>(3, 3) += sigma_rad * sigma_rad * Eigen::Matrix3d::Identity();
    covariance.block<3, 3>(9, 9) += kFirstTurn_rad_s * kFirstTurn_rad_s * Eigen::Matrix3d::Identity();
  } else {
    addNoise({config.max_angular_acceleration_rad_s2, kSeam_rad}, 3, dt_s, unseen_s, &covariance);
  }
  if (gyro_in_sweep) {  // what is estimated is the gyroscope's error, anew each scan
    prior.mean.velocity_base.tail<3>().setZero();
    covariance.bottomRows<3>().setZero();
    covariance.rightCols<3>().setZero();
    covariance.bottomRightCorner<3, 3>() = kGyro_rad_s * kGyro_rad_s * Eigen::Matrix3d::Identity();
  }
  prior.information = inverse(covariance);

  if (const auto T_odom = odom_in.motion(last.stamp_s, stamp_s)) {
    fuseOdomIn(last.mean.T_map_base, *T_odom, config, &prior);
  }
  return prior;
}

MotionPrior ignorantAround(const MovingPose& pose) {
  MotionPrior prior{pose, Matrix12::Zero()};
  prior.information.topLeftCorner<6, 6>() = covarianceOf(kLost_m, kLost_rad).inverse();
  prior.information.bottomRightCorner<6, 6>() =
      covarianceOf(kFirstSpeed_m_s, kFirstTurn_rad_s).inverse();
  return prior;
}

Matrix6 covarianceOfPose(const MotionPrior& prior) {
  return inverse(prior.information).topLeftCorner<6, 6>();
}

}  // namespace mrpt_sgraphs
