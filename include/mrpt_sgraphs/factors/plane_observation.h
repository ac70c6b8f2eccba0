// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// A keyframe sees a plane of the map: a wall, or the ground of a floor.
///
/// The plane (n, d) of the map, seen from the keyframe T_map_base = (R, t), is
///
///     n_b = R' n,   d_b = d - n . t,
///
/// and is compared with the plane (m, d_m) that was measured in the keyframe's cloud:
///
///     e = [ B(m)' n_b ]   2 rows, rad for small angles      e in R^3
///         [ d_b - d_m ]   1 row,  m
///
/// B(m) spans the tangent plane of the unit sphere at m, so e has no redundant row. n_b = -m also
/// gives e = 0 in the first two rows: association has to hand over planes of equal orientation.
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
    const Plane seen_base = inverseTimes(T_map_base, surface_map);

    if (J_keyframe != nullptr) {
      J_keyframe->setZero();
      J_keyframe->topRightCorner<2, 3>().noalias() =
          basis_base_.transpose() * skew(seen_base.normal);
      J_keyframe->bottomLeftCorner<1, 3>() = -seen_base.normal.transpose();
    }
    if (J_surface != nullptr) {
      const TangentBasis basis_map = tangentBasis(surface_map.normal);
      const Eigen::Matrix<double, 2, 3> to_base =
          basis_base_.transpose() * T_map_base.linear().transpose();
      J_surface->topLeftCorner<2, 2>().noalias() = to_base * basis_map;
      J_surface->topRightCorner<2, 1>().setZero();
      J_surface->bottomLeftCorner<1, 2>().noalias() =
          -T_map_base.translation().transpose() * basis_map;
      (*J_surface)(2, 2) = 1.0;
    }

    Residual e;
    e.head<2>().noalias() = basis_base_.transpose() * seen_base.normal;
    e.z() = seen_base.distance - measured_base.distance;
    return e;
  }

  const Plane measured_base;

 private:
  TangentBasis basis_base_;
};

}  // namespace mrpt_sgraphs
