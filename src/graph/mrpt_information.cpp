// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/mrpt_information.h"

#include <cmath>

namespace mrpt_sgraphs {
namespace {

/// The axes about which yaw, pitch and roll turn, in the body's frame.
struct TurningAxes {
  explicit TurningAxes(const Eigen::Matrix3d& R)
      : yaw(R.row(2)), cos_pitch(std::hypot(R(2, 1), R(2, 2))) {
    const bool is_pole = cos_pitch <= 0.0;  // any roll will do there: zero
    sin_roll = is_pole ? 0.0 : R(2, 1) / cos_pitch;
    cos_roll = is_pole ? 1.0 : R(2, 2) / cos_pitch;
  }

  Eigen::Vector3d yaw;  ///< R' e_z = [-sin(pitch), sin(roll) cos(pitch), cos(roll) cos(pitch)]
  double cos_pitch;
  double sin_roll = 0.0;
  double cos_roll = 1.0;
};

/// theta = E d(yaw pitch roll)
Eigen::Matrix3d turnOfAngles(const TurningAxes& axes) {
  Eigen::Matrix3d E;
  E.col(0) = axes.yaw;
  E.col(1) << 0.0, axes.cos_roll, -axes.sin_roll;
  E.col(2) = Eigen::Vector3d::UnitX();
  return E;
}

/// d(yaw pitch roll) = E^-1 theta
Eigen::Matrix3d anglesOfTurn(const TurningAxes& axes) {
  const double secant = axes.cos_pitch < kGimbalLockCosine ? 0.0 : 1.0 / axes.cos_pitch;
  Eigen::Matrix3d E_inverse;
  E_inverse.row(0) << 0.0, axes.sin_roll * secant, axes.cos_roll * secant;
  E_inverse.row(1) << 0.0, axes.cos_roll, -axes.sin_roll;
  E_inverse.row(2) = -axes.yaw.x() * E_inverse.row(0);
  E_inverse(2, 0) = 1.0;
  return E_inverse;
}

/// J' information J for the block-diagonal J, symmetric to the last bit.
Matrix6 transported(const Matrix6& information, const Eigen::Matrix3d& J_translation,
                    const Eigen::Matrix3d& J_rotation) {
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = J_translation;
  J.bottomRightCorner<3, 3>() = J_rotation;
  const Matrix6 product = J.transpose() * information * J;
  return 0.5 * (product + product.transpose());
}

}  // namespace

Matrix6 toYawPitchRollInformation(const Pose& T, const Matrix6& information) {
  const Eigen::Matrix3d R = T.linear();
  return transported(information, R.transpose(), turnOfAngles(TurningAxes(R)));
}

Matrix6 fromYawPitchRollInformation(const Pose& T, const Matrix6& information) {
  const Eigen::Matrix3d R = T.linear();
  return transported(information, R, anglesOfTurn(TurningAxes(R)));
}

Matrix6 permutedInformation(const Matrix6& information) {
  constexpr int kOrder[6] = {0, 1, 2, 5, 4, 3};
  Matrix6 permuted;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      permuted(row, column) = information(kOrder[row], kOrder[column]);
    }
  }
  return permuted;
}

}  // namespace mrpt_sgraphs
