// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs {

/// A relative pose as g2o files mean it (EDGE_SE3:QUAT): the rotation of
///
///     E = Z^-1 T_map_from^-1 T_map_to
///
/// is measured by the vector part of its unit quaternion with w >= 0, about half the rotation
/// vector:
///
///     e = [ translation of E ]   3 rows, m                                    e in R^6
///         [ q_vec of E       ]   3 rows, rad / 2 for small angles
///
/// It grows like the sine of half the angle, so its weight falls as the rotation nears pi. For what
/// we measure there is RelativePoseFactor; this is for files whose cost has to mean the same to
/// all.
///
/// Frames: both poses in `map`; the measurement Z = T_from_to.
class RelativePoseQuaternionFactor final : public ResidualFactor<6, Pose, Pose> {
 public:
  /// @param information  Inverse covariance of e, as it stands in the file.
  RelativePoseQuaternionFactor(NodeId from, NodeId to, const Pose& T_from_to,
                               const Matrix6& information, const RobustKernel& kernel = {})
      : ResidualFactor({from, to}, information, kernel), T_from_to(T_from_to) {}

  const char* type() const override { return "relative_pose_quaternion"; }

  Residual evaluate(const Pose& T_map_from, const Pose& T_map_to, Jacobian<Pose>* J_from,
                    Jacobian<Pose>* J_to) const override {
    const Pose seen_from_to = T_map_from.inverse() * T_map_to;
    const Pose error = T_from_to.inverse() * seen_from_to;
    Eigen::Quaterniond q(error.linear());
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    if (J_from != nullptr || J_to != nullptr) {
      const Eigen::Matrix3d J_rotation =
          0.5 * (q.w() * Eigen::Matrix3d::Identity() + skew(q.vec()));
      relativePoseJacobians(T_from_to, seen_from_to, error, J_rotation, J_from, J_to);
    }
    Residual e;
    e << error.translation(), q.vec();
    return e;
  }

  const Pose T_from_to;
};

}  // namespace mrpt_sgraphs
