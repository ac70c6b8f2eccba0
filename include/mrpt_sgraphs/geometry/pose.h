// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mrpt_sgraphs {

/// A rigid motion. `T_a_b` takes coordinates in frame b to coordinates in frame a, and names chain by
/// their inner letters: `T_map_body * T_body_lidar`. Metres and radians; frames as in REP-105.
using Pose = Eigen::Isometry3d;

/// `[t; theta]`: metres, radians. The order of `mrpt::poses::Lie::SE<3>`.
using Tangent = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Whether it is one: a rotation but for rounding, everything finite.
inline bool isSound(const Pose& T) {
  constexpr double kMaxError = 1e-6;  // written so that NaN is none
  const Eigen::Matrix3d R = T.linear();
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < kMaxError &&
         R.determinant() > 0.0 && T.translation().allFinite();
}

/// The matrix of `v x`: skew(v) * w == v.cross(w).
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Rotation by |theta| about theta (Rodrigues), exact near zero.
inline Eigen::Matrix3d expSO3(const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  const Eigen::Matrix3d k = skew(theta);
  constexpr double kTiny_rad = 1e-5;  // below it the series is exact to double precision
  const double a = angle < kTiny_rad ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double b =
      angle < kTiny_rad ? 0.5 - angle * angle / 24.0 : (1.0 - std::cos(angle)) / (angle * angle);
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

/// The rotation vector of R, of length at most pi.
inline Eigen::Vector3d logSO3(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const double sine = q.vec().norm();
  constexpr double kTiny = 1e-9;
  const double scale = sine < kTiny ? 2.0 / q.w() : 2.0 * std::atan2(sine, q.w()) / sine;
  return scale * q.vec();
}

/// The pseudo-exponential of `mrpt::poses::Lie::SE<3>`: translation and rotation are not coupled.
inline Pose expPose(const Tangent& delta) {
  Pose T = Pose::Identity();
  T.linear() = expSO3(delta.tail<3>());
  T.translation() = delta.head<3>();
  return T;
}

/// The pseudo-logarithm, inverse of expPose.
inline Tangent logPose(const Pose& T) {
  Tangent delta;
  delta << T.translation(), logSO3(T.linear());
  return delta;
}

/// The exponential of SE(3): a screw motion. Agrees with expPose to first order; a rigid motion of
/// many poses at once, each moved by its own share of one twist, stays rigid however large it is.
inline Pose expSE3(const Tangent& delta) {
  const Eigen::Vector3d theta = delta.tail<3>();
  const double angle2 = theta.squaredNorm();
  constexpr double kTiny_rad2 = 1e-8;
  const bool tiny = angle2 < kTiny_rad2;
  const double angle = std::sqrt(angle2);
  const double a = tiny ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double b = tiny ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  const Eigen::Vector3d v = delta.head<3>();
  const Eigen::Vector3d turned = theta.cross(v);
  Pose T = Pose::Identity();
  T.linear() = expSO3(theta);
  T.translation() = v + a * turned + b * theta.cross(turned);
  return T;
}

/// Perturbation on the right: `T exp(delta)`. retract(T, local(T, S)) == S.
inline Pose retract(const Pose& T, const Tangent& delta) { return T * expPose(delta); }
inline Tangent local(const Pose& T, const Pose& S) { return logPose(T.inverse() * S); }

/// Moves a covariance of the right perturbation of T to that of `T * T_body_other`.
inline Matrix6 adjointOfInverse(const Pose& T_body_other) {
  const Eigen::Matrix3d R_t = T_body_other.linear().transpose();
  Matrix6 adjoint = Matrix6::Zero();
  adjoint.topLeftCorner<3, 3>() = R_t;
  adjoint.topRightCorner<3, 3>() = -R_t * skew(T_body_other.translation());
  adjoint.bottomRightCorner<3, 3>() = R_t;
  return adjoint;
}

/// The pose a fraction `s` of the way from A to B: straight line, constant turning rate.
inline Pose interpolate(const Pose& A, const Pose& B, double s) {
  Pose T = Pose::Identity();
  T.translation() = A.translation() + s * (B.translation() - A.translation());
  T.linear() = A.linear() * expSO3(s * logSO3(A.linear().transpose() * B.linear()));
  return T;
}

/// A rotation that accumulated rounding errors, made orthonormal again.
inline Pose orthonormalized(const Pose& T) {
  Pose result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace mrpt_sgraphs
