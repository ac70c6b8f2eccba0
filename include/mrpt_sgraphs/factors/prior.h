// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs {

/// Priors are absolute: they hold a node in `map`, and have to be moved with it when it moves.

/// A keyframe or room is at a known place:
///
///     e = log( prior^-1 T )     3 rows, m; 3 rows, rad      e in R^6
///
/// Frames: both in `map`.
class PosePriorFactor final : public ResidualFactor<6, Pose> {
 public:
  /// @param information  Inverse covariance of the right perturbation of the pose, `[t; theta]`.
  PosePriorFactor(NodeId node, const Pose& prior_map, const Information& information,
                  const RobustKernel& kernel = {})
      : ResidualFactor({node}, information, kernel), prior_map(prior_map) {}

  const char* type() const override { return "pose_prior"; }

  Residual evaluate(const Pose& T_map_node, Jacobian<Pose>* J_node) const override {
    return relativePoseResidual(prior_map, Pose::Identity(), T_map_node, nullptr, J_node);
  }

  const Pose prior_map;
};

/// A wall or floor is at a known place: the residual of PlaneObservationFactor with a pose that
/// does not move. An angle and a distance mean something only from where they are measured, and
/// with that pose the prior moves with the map as it is.
///
/// Frames: the reference and the plane in `map`; the prior in the reference.
class PlanePriorFactor final : public ResidualFactor<3, Plane> {
 public:
  /// @param information  Inverse covariance of e: symmetric, 1/rad^2, 1/(rad m), 1/m^2.
  PlanePriorFactor(NodeId surface, const Pose& T_map_reference, const Plane& prior_reference,
                   const Information& information, const RobustKernel& kernel = {})
      : ResidualFactor({surface}, information, kernel),
        T_map_reference(T_map_reference),
        prior_reference(prior_reference),
        basis_reference_(tangentBasis(prior_reference.normal)) {}

  const char* type() const override { return "plane_prior"; }

  Residual evaluate(const Plane& surface_map, Jacobian<Plane>* J_surface) const override {
    return planeResidual(prior_reference, basis_reference_, T_map_reference, surface_map, nullptr,
                         J_surface);
  }

  const Pose T_map_reference;
  const Plane prior_reference;

 private:
  TangentBasis basis_reference_;
};

}  // namespace mrpt_sgraphs
