// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// A surface seen from one side: the points p with `normal . p = distance`, the unit normal pointing
/// to the side that it was seen from. The two faces of one wall are two planes of opposite normals.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double distance = 0.0;  ///< [m] Of the plane from the origin, along the normal; may be negative.
};

/// Whether it is one: a unit normal but for rounding, everything finite.
inline bool isSound(const Plane& plane) {
  constexpr double kMaxError = 1e-6;  // written so that NaN is none
  return std::abs(plane.normal.norm() - 1.0) < kMaxError && std::isfinite(plane.distance);
}

/// `[a; b; d]`: the normal's turn along the two columns of tangentBasis(normal) [rad, small], and
/// the change of the distance [m].
using PlaneTangent = Eigen::Vector3d;
using TangentBasis = Eigen::Matrix<double, 3, 2>;

/// Two orthonormal vectors that are orthogonal to the unit vector n (Duff et al., "Building an
/// Orthonormal Basis, Revisited", 2017). Not continuous where n.z changes its sign.
inline TangentBasis tangentBasis(const Eigen::Vector3d& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  TangentBasis basis;
  basis << 1.0 + sign * n.x() * n.x() * a, b,  //
      sign * b, sign + n.y() * n.y() * a,      //
      -sign * n.x(), -n.y();
  return basis;
}

/// plane_a = T_a_b * plane_b, as for points.
inline Plane operator*(const Pose& T_a_b, const Plane& plane_b) {
  const Eigen::Vector3d normal_a = T_a_b.linear() * plane_b.normal;
  return {normal_a, plane_b.distance + normal_a.dot(T_a_b.translation())};
}

/// plane_b = T_a_b^-1 * plane_a, without the inverse.
inline Plane inverseTimes(const Pose& T_a_b, const Plane& plane_a) {
  return {T_a_b.linear().transpose() * plane_a.normal,
          plane_a.distance - plane_a.normal.dot(T_a_b.translation())};
}

/// Moves a plane along its tangent: the normal goes to `n + B(n) [a; b]`, made a unit vector again,
/// also where the square of a step overflows: a solver may try any.
inline Plane retract(const Plane& plane, const PlaneTangent& delta) {
  const Eigen::Vector3d moved = plane.normal + tangentBasis(plane.normal) * delta.head<2>();
  return {moved.stableNormalized(), plane.distance + delta.z()};
}

/// Inverse of retract: retract(p, local(p, q)) == q, for normals less than 90 degrees apart.
inline PlaneTangent local(const Plane& p, const Plane& q) {
  PlaneTangent delta;
  delta << tangentBasis(p.normal).transpose() * q.normal / p.normal.dot(q.normal),
      q.distance - p.distance;
  return delta;
}

}  // namespace mrpt_sgraphs
