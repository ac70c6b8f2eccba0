// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs::test {

constexpr double kScanPeriod_s = 0.1;

/// A curved walk through three dimensions: `scans` poses, 0.1 m and 0.1 s apart.
inline Trajectory walk(int scans) {
  Trajectory trajectory;
  Pose T = Pose::Identity();
  for (int k = 0; k < scans; ++k) {
    trajectory.push_back({1.6e9 + k * kScanPeriod_s, T});
    Tangent step;
    step << 0.1, 0.0, 0.0, 0.0, 0.02 * std::sin(0.05 * k), 0.02;
    T = retract(T, step);
  }
  return trajectory;
}

/// The same walk in another world frame.
inline Trajectory moved(const Pose& T_other_world, Trajectory trajectory) {
  for (StampedPose& pose : trajectory) pose.T_world_body = T_other_world * pose.T_world_body;
  return trajectory;
}

/// Positions with independent errors along each axis.
inline Trajectory withNoise(Trajectory trajectory, double sigma_m, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, sigma_m);
  for (StampedPose& pose : trajectory) {
    for (int axis = 0; axis < 3; ++axis) pose.T_world_body.translation()[axis] += noise(generator);
  }
  return trajectory;
}

/// Some rigid motion, far away and well turned.
inline Pose someMotion() {
  Tangent delta;
  delta << 120.0, -35.0, 8.0, 0.3, -0.8, 2.4;
  return expPose(delta);
}

}  // namespace mrpt_sgraphs::test
