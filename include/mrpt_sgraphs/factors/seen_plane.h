// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

/// The rows that factors between poses and planes are made of. The plane (n, d) of the map, seen
/// from the pose T_map_base = (R, t), is
///
///     n_b = R' n,   d_b = d - n . t                                          (inverseTimes)
///
/// Two rows of a residual are its normal along a basis B of two directions of that frame, B' n_b,
/// and one is its distance d_b. Below, how they change with the tangents of pose and plane.

/// B' n_b with the pose.
inline Eigen::Matrix<double, 2, 6> normalByPose(const TangentBasis& basis_base,
                                                const Plane& seen_base) {
  Eigen::Matrix<double, 2, 6> J;
  J.leftCols<3>().setZero();
  J.rightCols<3>().noalias() = basis_base.transpose() * skew(seen_base.normal);
  return J;
}

/// B' n_b with the plane.
inline Eigen::Matrix<double, 2, 3> normalByPlane(const TangentBasis& basis_base,
                                                 const Pose& T_map_base, const Plane& plane_map) {
  const TangentBasis basis_map = tangentBasis(plane_map.normal);
  Eigen::Matrix<double, 2, 3> J;
  J.leftCols<2>().noalias() =
      (basis_base.transpose() * T_map_base.linear().transpose()) * basis_map;
  J.rightCols<1>().setZero();
  return J;
}

/// d_b with the pose.
inline Eigen::Matrix<double, 1, 6> distanceByPose(const Plane& seen_base) {
  Eigen::Matrix<double, 1, 6> J;
  J << -seen_base.normal.transpose(), Eigen::RowVector3d::Zero();
  return J;
}

/// d_b with the plane.
inline Eigen::Matrix<double, 1, 3> distanceByPlane(const Pose& T_map_base, const Plane& plane_map) {
  Eigen::Matrix<double, 1, 3> J;
  J << -T_map_base.translation().transpose() * tangentBasis(plane_map.normal), 1.0;
  return J;
}

}  // namespace mrpt_sgraphs
