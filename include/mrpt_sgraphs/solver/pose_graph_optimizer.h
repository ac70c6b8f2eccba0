// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/pose.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// A relative pose between two keyframes: T_from_to as measured, with the inverse covariance of its
/// right perturbation, `[t; theta]`.
struct RelativePoseEdge {
  enum class Kind { kOdometry, kLoopClosure };

  KeyframeId from;
  KeyframeId to;
  Pose T_from_to = Pose::Identity();
  Matrix6 information = Matrix6::Identity();  ///< [1/m^2, 1/(m rad), 1/rad^2]
  Kind kind = Kind::kOdometry;
};

/// How the pose graph is optimized.
struct PoseGraphOptimizerConfig {
  int max_iterations = 50;
  double min_relative_decrease = 1e-6;  ///< Of the cost in one iteration: less is converged.
  double loop_kernel_chi2 = 12.6;       ///< Loops with a larger chi^2 (6 dof, 5 %) lose weight.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("max_iterations", self.max_iterations, 1, 10000);
    field("min_relative_decrease", self.min_relative_decrease, 1e-15, 0.1);
    field("loop_kernel_chi2", self.loop_kernel_chi2, 0.1, 1e6);
  }
};

/// Levenberg-Marquardt over relative poses, sparse Cholesky inside. Loop closures carry a Cauchy
/// kernel: one that contradicts all others loses its weight instead of bending the map.
///
/// @param poses  T_map_base, initial in and optimized out; the pose with the lowest id stays. Left as
///               it is if the problem is not solvable, which the summary then says.
OptimizationSummary optimizePoseGraph(const std::vector<RelativePoseEdge>& edges,
                                      const PoseGraphOptimizerConfig& config,
                                      std::map<KeyframeId, Pose>* poses);

}  // namespace mrpt_sgraphs
