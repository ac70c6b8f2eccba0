// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// Inverse of the right Jacobian of SO(3): log(exp(theta) exp(delta)) = theta + J delta.
inline Eigen::Matrix3d inverseRightJacobian(const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  const Eigen::Matrix3d k = skew(theta);
  constexpr double kTiny_rad = 1e-4;
  const double b = angle < kTiny_rad
                       ? 1.0 / 12.0
                       : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  return Eigen::Matrix3d::Identity() + 0.5 * k + b * k * k;
}

/// How the error pose E = Z^-1 T_map_from^-1 T_map_to changes with both poses, its rotation
/// measured by a residual r(E) of three rows with d r = J_rotation dtheta for E exp(dtheta).
inline void relativePoseJacobians(const Pose& measured_from_to, const Pose& T_from_to,
                                  const Pose& error, const Eigen::Matrix3d& J_rotation,
                                  Matrix6* J_from, Matrix6* J_to) {
  if (J_from != nullptr) {
    const Eigen::Matrix3d R_to_from = T_from_to.linear().transpose();
    const Eigen::Matrix3d R_z_from = measured_from_to.linear().transpose();
    *J_from << -R_z_from, R_z_from * skew(T_from_to.translation()),  //
        Eigen::Matrix3d::Zero(), -J_rotation * R_to_from;
  }
  if (J_to != nullptr) {
    *J_to << error.linear(), Eigen::Matrix3d::Zero(),  //
        Eigen::Matrix3d::Zero(), J_rotation;
  }
}

/// Two poses and the relative pose measured between them:
///
///     e = log( Z^-1 T_map_from^-1 T_map_to )     3 rows, m; 3 rows, rad      e in R^6
///
/// with the pseudo-logarithm of `mrpt::poses::Lie::SE<3>`: the translation as it stands, the
/// rotation vector below it. Jacobians with respect to right perturbations.
///
/// Frames: both poses in `map`; the measurement Z = T_from_to.
inline Tangent relativePoseResidual(const Pose& measured_from_to, const Pose& T_map_from,
                                    const Pose& T_map_to, Matrix6* J_from, Matrix6* J_to) {
  const Pose T_from_to = T_map_from.inverse() * T_map_to;
  const Pose error = measured_from_to.inverse() * T_from_to;
  const Tangent e = logPose(error);
  if (J_from != nullptr || J_to != nullptr) {
    relativePoseJacobians(measured_from_to, T_from_to, error, inverseRightJacobian(e.tail<3>()),
                          J_from, J_to);
  }
  return e;
}

/// Odometry, a loop closure, the paper's bridge over marginalized keyframes, or where a keyframe
/// has the room that it is in (room_walls.h).
class RelativePoseFactor final : public ResidualFactor<6, Pose, Pose> {
 public:
  enum class Kind { kOdometry, kLoopClosure, kBridge, kRoom };

  /// @param information  Inverse covariance of the right perturbation of T_from_to, `[t; theta]`.
  RelativePoseFactor(NodeId from, NodeId to, const Pose& T_from_to, const Matrix6& information,
                     Kind kind = Kind::kOdometry, const RobustKernel& kernel = {})
      : ResidualFactor({from, to}, information, kernel), T_from_to(T_from_to), kind(kind) {}

  const char* type() const override {
    constexpr const char* kTypes[] = {"odometry", "loop_closure", "bridge", "room_pose"};
    return kTypes[static_cast<int>(kind)];
  }

  Residual evaluate(const Pose& T_map_from, const Pose& T_map_to, Jacobian<Pose>* J_from,
                    Jacobian<Pose>* J_to) const override {
    return relativePoseResidual(T_from_to, T_map_from, T_map_to, J_from, J_to);
  }

  const Pose T_from_to;
  const Kind kind;
};

}  // namespace mrpt_sgraphs
