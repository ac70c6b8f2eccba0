// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/frontend/voxel_map.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// How points are fitted to a map of planes.
struct RegistrationConfig {
  int max_iterations = 30;
  double range_sigma_m = 0.01;     ///< Of a point along the normal of the plane it lies on.
  double max_distance_m = 0.5;     ///< A point farther from its plane is something else.
  double min_eigenvalue = 400.0;   ///< Less information [1/m^2, at 5 m lever] is a degenerate direction.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("max_iterations", self.max_iterations, 1, 200);
    field("range_sigma_m", self.range_sigma_m, 0.001, 1.0);
    field("max_distance_m", self.max_distance_m, 0.01, 10.0);
    field("min_eigenvalue", self.min_eigenvalue, 0.0, 1e9);
  }
};

/// A point to be registered.
struct ScanPoint {
  /// [m] in the base frame at the time it was measured, or turned to the stamp's by a gyroscope.
  Eigen::Vector3d position;
  double time_s = 0.0;       ///< from the scan's stamp
};

/// A pose at the scan's stamp and the motion about it: a point p of time tau sits, in the base frame
/// of the stamp, at exp(tau omega) p + tau v. With a gyroscope omega is what it has wrong.
struct MovingPose {
  Pose T_map_base = Pose::Identity();
  Tangent velocity_base = Tangent::Zero();  ///< [v; omega], m/s and rad/s

  template <typename Archive>
  void archive(Archive& a) {
    a("T_map_base", T_map_base);
    a("velocity_base", velocity_base);
  }
};

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// What is believed of a MovingPose before a scan is seen: 12 unknowns, the pose's six (right
/// perturbation) before the velocity's.
struct MotionPrior {
  MovingPose mean;
  Matrix12 information = Matrix12::Zero();
};

/// Where a point is in the base frame of the stamp: its motion removed.
Eigen::Vector3d pointAtStamp(const ScanPoint& point, const Tangent& velocity_base);

struct RegistrationResult {
  MovingPose estimate;
  Matrix6 information = Matrix6::Zero();  ///< Of T_map_base from the points, its velocity free.
  Matrix12 posterior_information = Matrix12::Zero();  ///< Of all, from points and prior.
  int degenerate_directions = 0;
  int matched = 0;           ///< Points that have a plane and lie on it.
  double inlier_ratio = 0.0; ///< matched / all
  /// matched / those that have a plane at all: near 1 in the right place, whatever part of the scan
  /// is of new surroundings.
  double consistency = 0.0;
  double rms_m = 0.0;        ///< Of the matched points' distances.
  int iterations = 0;
  bool converged = false;
};

/// Where a registration begins to look.
struct RegistrationStart {
  MovingPose pose;
  /// Of the map: 0 near the solution, up to kLevels - 1 where it may be off by metres.
  int level = 0;
};

/// Fits the points to the planes of the map: iteratively re-weighted point-to-plane with a Cauchy
/// kernel. Directions with less information than `min_eigenvalue` are left to the prior.
/// @param viewpoint_base  The sensor's place on the robot.
RegistrationResult registerScan(const std::vector<ScanPoint>& points, const VoxelMap& map,
                                const MotionPrior& prior, const RegistrationStart& start,
                                const Eigen::Vector3d& viewpoint_base,
                                const RegistrationConfig& config);

}  // namespace mrpt_sgraphs
