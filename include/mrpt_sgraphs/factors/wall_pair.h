// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/factor.h"
#include "mrpt_sgraphs/factors/seen_plane.h"

namespace mrpt_sgraphs {

/// Two faces of one wall: opposite normals, and the wall's thickness between them. Seen from the
/// keyframe, the faces (n_a, d_a) and (n_b, d_b) have the normals R' n and the distances
/// d_k = d - n . t, and
///
///     e = [ B(m)' R' (n_a + n_b)     ]   2 rows, rad for small angles      e in R^3
///         [ d_ka + d_kb - thickness  ]   1 row,  m
///
/// where m is the normal of face a, as measured from the keyframe. The keyframe says where the
/// thickness was measured: two planes that are not quite parallel have none elsewhere, and with the
/// distances from the map's origin, e would depend on where that is. Two faces of equal normals
/// give the first rows zero as well: association has to hand over opposite ones.
///
/// Frames: T_map_base and the faces in `map`; the measurement in the keyframe's base.
class WallPairFactor final : public ResidualFactor<3, Pose, Plane, Plane> {
 public:
  /// @param normal_a_base  The direction m of face a as measured; a unit vector.
  /// @param thickness_m    From face a, against its normal, to face b.
  /// @param information    Inverse covariance of e: symmetric, 1/rad^2, 1/(rad m), 1/m^2.
  WallPairFactor(KeyframeId keyframe, WallId face_a, WallId face_b,
                 const Eigen::Vector3d& normal_a_base, double thickness_m,
                 const Information& information, const RobustKernel& kernel = {})
      : ResidualFactor({keyframe, face_a, face_b}, information, kernel),
        normal_a_base(normal_a_base),
        thickness_m(thickness_m),
        basis_base_(tangentBasis(normal_a_base)) {}

  const char* type() const override { return "wall_pair"; }

  Residual evaluate(const Pose& T_map_base, const Plane& a_map, const Plane& b_map,
                    Jacobian<Pose>* J_keyframe, Jacobian<Plane>* J_a,
                    Jacobian<Plane>* J_b) const override {
    const Plane a_base = inverseTimes(T_map_base, a_map);
    const Plane b_base = inverseTimes(T_map_base, b_map);
    const Plane sum_base{a_base.normal + b_base.normal, a_base.distance + b_base.distance};

    if (J_keyframe != nullptr) {
      *J_keyframe << normalByPose(basis_base_, sum_base), distanceByPose(sum_base);
    }
    if (J_a != nullptr) {
      *J_a << normalByPlane(basis_base_, T_map_base, a_map), distanceByPlane(T_map_base, a_map);
    }
    if (J_b != nullptr) {
      *J_b << normalByPlane(basis_base_, T_map_base, b_map), distanceByPlane(T_map_base, b_map);
    }

    Residual e;
    e << basis_base_.transpose() * sum_base.normal, sum_base.distance - thickness_m;
    return e;
  }

  const Eigen::Vector3d normal_a_base;
  const double thickness_m;

 private:
  TangentBasis basis_base_;
};

}  // namespace mrpt_sgraphs
