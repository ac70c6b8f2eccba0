// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs::test {

/// Seeded poses and vectors.
class RandomGeometry {
 public:
  explicit RandomGeometry(unsigned seed, double extent_m = 1.0)
      : generator_(seed), extent_m_(extent_m) {}

  double number(double limit) {
    return std::uniform_real_distribution<double>(-limit, limit)(generator_);
  }
  Eigen::Vector3d vector(double limit) { return {number(limit), number(limit), number(limit)}; }

  /// Anywhere within the extent, turned in any way.
  Pose pose() {
    Tangent delta;
    delta << vector(extent_m_), M_PI * Eigen::Vector3d(vector(1.0)).normalized() * number(0.99);
    return expPose(delta);
  }

  /// A pose at most so far from identity.
  Pose smallPose(double limit_m, double limit_rad) {
    Tangent delta;
    delta << vector(limit_m), vector(limit_rad);
    return expPose(delta);
  }

 private:
  std::mt19937 generator_;
  double extent_m_;
};

}  // namespace mrpt_sgraphs::test
