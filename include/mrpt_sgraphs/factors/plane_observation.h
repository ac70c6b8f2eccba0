// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/factor.h"
#include "mrpt_sgraphs/factors/seen_plane.h"

namespace mrpt_sgraphs {

/// A plane of the map, seen from a pose, against what was measured from there. The plane (n, d) of
/// the map, seen from T_map_base = (R, t), is
///
///     n_b = R' n,   d_b = d - n . t,
///
/// and is compared with the plane (m, d_m):
///
///     e = [ B(m)' n_b ]   2 rows, rad for small angles      e in R^3
///         [ d_b - d_m ]   1 row,  m
///
/// B(m) spans the tangent plane of the unit sphere at m, so e has no redundant row. n_b = -m also
/// gives e = 0 in the first two rows: association has to hand over planes of equal orientation.
///
/// @param basis_base  tangentBasis(measured_base.normal).
inline Eigen::Vector3d planeResidual(const Plane& measured_base, const TangentBasis& basis_base,
                                     const Pose& T_map_base, const Plane& plane_map,
                                     Eigen::Matrix<double, 3, 6>* J_pose,
                                     Eigen::Matrix3d* J_plane) {
  const Plane seen_base = inverseTimes(T_map_base, plane_map);
  if (J_pose != nullptr) {
    J_pose->topRows<2>() = normalByPose(basis_base, seen_base);
    J_pose->bottomRows<1>() = distanceByPose(seen_base);
  }
  if (J_plane != nullptr) {
    J_plane->topRows<2>() = normalByPlane(basis_base, T_map_base, plane_map);
    J_plane->bottomRows<1>() = distanceByPlane(T_map_base, plane_map);
  }
  Eigen::Vector3d e;
  e.head<2>().noalias() = basis_base.transpose() * seen_base.normal;
  e.z() = seen_base.distance - measured_base.distance;
  return e;
}

/// A keyframe sees a plane of the map, a wall or the ground of a floor: planeResidual.
///
/// Frames: T_map_base and the plane in `map`; the measurement in the keyframe's base.
class PlaneObservationFactor final : public ResidualFactor<3, Pose, Plane> {
 public:
  /// @param surface      A wall or a floor.
  /// @param information  Inverse covariance of e: symmetric, 1/rad^2, 1/(rad m), 1/m^2.
  PlaneObservationFactor(KeyframeId keyframe, NodeId surface, const Plane& measured_base,
                         const Information& information, const RobustKernel& kernel = {})
      : ResidualFactor({keyframe, surface}, information, kernel),
        measured_base(measured_base),
        basis_base_(tangentBasis(measured_base.normal)) {}

  const char* type() const override {
    return node(1).layer == Layer::kFloor ? "ground_observation" : "wall_observation";
  }

  Residual evaluate(const Pose& T_map_base, const Plane& surface_map, Jacobian<Pose>* J_keyframe,
                    Jacobian<Plane>* J_surface) const override {
    return planeResidual(measured_base, basis_base_, T_map_base, surface_map, J_keyframe,
                         J_surface);
  }

  const Plane measured_base;

 private:
  TangentBasis basis_base_;
};

}  // namespace mrpt_sgraphs
