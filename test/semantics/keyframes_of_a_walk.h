// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/thinning.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs::test {

/// A keyframe and where it truly was.
struct KeyframeWithTruth {
  Keyframe keyframe;
  Pose T_map_base = Pose::Identity();
};

/// What odometry gets wrong on a walk, and what it says of that.
struct WalkErrors {
  Eigen::Vector3d drift_m{0.0, 0.0, 0.0};  ///< At the end; it grows evenly with the way.
  double drift_rad = 0.0;
  double sigma_m = 0.02;  ///< Claimed, from keyframe to keyframe.
  double sigma_rad = 0.004;
};

/// Keyframes of a robot that walks along corner points at a metre each and stops for every scan.
/// The first is the origin of `odom`.
inline std::vector<KeyframeWithTruth> walk(const ScanStage& stage,
                                           const std::vector<Eigen::Vector2d>& corners,
                                           const WalkErrors& errors) {
  std::vector<SteadyMotion> places;
  for (std::size_t corner = 1; corner < corners.size(); ++corner) {
    const Eigen::Vector2d leg = corners[corner] - corners[corner - 1];
    const int steps = static_cast<int>(std::ceil(leg.norm()));
    for (int step = corner == 1 ? 0 : 1; step <= steps; ++step) {
      places.push_back({corners[corner - 1] + step * leg / steps, std::atan2(leg.y(), leg.x())});
    }
  }

  constexpr double kStepPeriod_s = 1.0;
  constexpr double kVoxel_m = 0.08;
  std::vector<KeyframeWithTruth> keyframes;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const PlacedScan scan = stage.scan(places[k], 1 + k);
    KeyframeWithTruth result;
    result.T_map_base = scan.T_map_base;
    result.keyframe.stamp_s = kStepPeriod_s * static_cast<double>(1 + k);
    const double share = static_cast<double>(k) / static_cast<double>(places.size() - 1);
    Tangent drift;
    drift << share * errors.drift_m, 0.0, 0.0, share * errors.drift_rad;
    const Pose T_map_first = k == 0 ? scan.T_map_base : keyframes.front().T_map_base;
    result.keyframe.T_odom_base = expPose(drift) * T_map_first.inverse() * scan.T_map_base;
    Tangent variance;
    variance << Eigen::Vector3d::Constant(errors.sigma_m * errors.sigma_m),
        Eigen::Vector3d::Constant(errors.sigma_rad * errors.sigma_rad);
    result.keyframe.covariance = variance.asDiagonal();
    result.keyframe.cloud = thinned(*scan.cloud, kVoxel_m);
    keyframes.push_back(result);
  }
  return keyframes;
}

/// From the corridor of the small building through both rooms and back to the start.
inline std::vector<Eigen::Vector2d> roundOfTheSmallBuilding() {
  return {{1.0, 1.0}, {2.4, 1.0}, {2.4, 3.4}, {3.3, 4.4}, {2.0, 5.2}, {1.5, 4.0}, {2.4, 3.2},
          {2.4, 1.0}, {6.8, 1.0}, {6.8, 3.0}, {7.9, 4.0}, {6.6, 4.8}, {6.8, 3.0}, {6.8, 1.0},
          {1.2, 1.0}};
}

}  // namespace mrpt_sgraphs::test
