// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

/// What no surface is known better than: sightings from about one place have the same systematic
/// error, and no sum of them goes below it.
struct SigmaFloor {
  double m = 0.005;
  double rad = 0.002;
};

/// A plane's error as it is felt at a point: how the turns along the tangent basis and the offset
/// *at that point* make up the PlaneTangent, whose distance is at the origin.
///
///     n . p = d for the points p of the plane: turned by B [a; b] about c, d changes by c . B [a; b]
///
/// @param point  c, in the frame of the plane [m].
inline Eigen::Matrix3d tangentFromPoint(const Plane& plane, const Eigen::Vector3d& point) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.bottomLeftCorner<1, 2>() = point.transpose() * tangentBasis(plane.normal);
  return J;
}

/// How the PlaneTangent of `T_a_b * plane_b` follows from that of plane_b.
inline Eigen::Matrix3d tangentByMotion(const Pose& T_a_b, const Plane& plane_b) {
  const Eigen::Matrix3d R = T_a_b.linear();
  const TangentBasis basis_b = tangentBasis(plane_b.normal);
  const TangentBasis basis_a = tangentBasis(R * plane_b.normal);
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J.topLeftCorner<2, 2>() = basis_a.transpose() * R * basis_b;
  J.bottomLeftCorner<1, 2>() = T_a_b.translation().transpose() * R * basis_b;
  return J;
}

/// Moves a covariance of the PlaneTangent of plane_b to that of `T_a_b * plane_b`.
inline Eigen::Matrix3d transported(const Eigen::Matrix3d& covariance_b, const Pose& T_a_b,
                                   const Plane& plane_b) {
  const Eigen::Matrix3d J = tangentByMotion(T_a_b, plane_b);
  return J * covariance_b * J.transpose();
}

}  // namespace mrpt_sgraphs
