// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/scan_matcher.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/frontend/motion_model.h"

namespace mrpt_sgraphs {
namespace {

/// Fewer points on their planes than this, and the pose is not to be trusted;
constexpr double kMinInlierRatio = 0.15;
/// fewer of those that have a plane, and the place is the wrong one.
constexpr double kMinConsistency = 0.5;
/// A share of inliers that falls below this part of the usual one is no good fit.
constexpr double kSuspicious = 0.8;
/// A pose that is farther from its prediction than this (chi^2, 6 degrees of freedom) was not
/// predicted at all.
constexpr double kMaxSurprise = 100.0;
/// A prediction that may be farther off than this finds the wrong planes. An error in heading is
/// weighed at the lever below.
constexpr double kMaxReach_m = 0.5;
constexpr double kLever_m = 5.0;
/// The search tries headings to both sides, with few points and from the coarsest level on.
constexpr double kSearchStep_rad = 0.17;
constexpr double kMaxSearch_rad = 0.8;
constexpr std::size_t kSearchPoints = 600;

/// How far a point near the robot may be from where the prior has it, one sigma.
double reachOf(const Matrix6& covariance) {
  return std::sqrt(covariance.topLeftCorner<3, 3>().diagonal().maxCoeff()) +
         kLever_m * std::sqrt(covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff());
}

/// Where a coarse search about the prior's mean fits best.
MovingPose bestStart(const std::vector<ScanPoint>& points, const VoxelMap& map,
                     const MotionPrior& prior, const Eigen::Vector3d& viewpoint_base,
                     const RegistrationConfig& config) {
  std::vector<ScanPoint> few;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSearchPoints);
  for (std::size_t i = 0; i < points.size(); i += stride) few.push_back(points[i]);

  const double reach_rad = std::min(2.0 * std::sqrt(covarianceOfPose(prior)(5, 5)), kMaxSearch_rad);
  const int steps = static_cast<int>(std::ceil(reach_rad / kSearchStep_rad));
  MovingPose best = prior.mean;
  double best_ratio = 0.0;
  for (int step = -steps; step <= steps; ++step) {
    MotionPrior turned = prior;  // each on its own terms: the prior would favour the middle
    turned.mean.T_map_base.linear() =
        prior.mean.T_map_base.linear() * expSO3(step * kSearchStep_rad * Eigen::Vector3d::UnitZ());
    const RegistrationResult fit = registerScan(few, map, turned, {turned.mean, VoxelMap::kLevels - 1},
                                                viewpoint_base, config);
    if (fit.inlier_ratio > best_ratio) {
      best_ratio = fit.inlier_ratio;
      best = fit.estimate;
    }
  }
  return best;
}

}  // namespace

RegistrationResult ScanMatcher::match(const std::vector<ScanPoint>& points, const VoxelMap& map,
                                      const MotionPrior& prior,
                                      const Eigen::Vector3d& viewpoint_base) {
  RegistrationResult best = registerScan(points, map, prior, {prior.mean}, viewpoint_base, config_);
  const auto search = [&](const MotionPrior& from) {
    const MovingPose start = bestStart(points, map, from, viewpoint_base, config_);
    const RegistrationResult fit = registerScan(points, map, from, {start}, viewpoint_base, config_);
    if (fit.inlier_ratio > best.inlier_ratio) best = fit;
  };
  const auto suspicious = [&] { return best.inlier_ratio < kSuspicious * usual_inlier_ratio_; };

  const Matrix6 covariance = covarianceOfPose(prior);
  if (reachOf(covariance) > kMaxReach_m || suspicious()) search(prior);

  const Tangent surprise = local(prior.mean.T_map_base, best.estimate.T_map_base);
  if (suspicious() || surprise.dot(covariance.ldlt().solve(surprise)) > kMaxSurprise) {
    search(ignorantAround(prior.mean));
  }
  constexpr double kMemory = 0.9;
  usual_inlier_ratio_ = kMemory * usual_inlier_ratio_ + (1.0 - kMemory) * best.inlier_ratio;
  return best;
}

bool isTrustworthy(const RegistrationResult& fit) {
  return fit.matched > 0 && fit.inlier_ratio >= kMinInlierRatio &&
         fit.consistency >= kMinConsistency;
}

}  // namespace mrpt_sgraphs
