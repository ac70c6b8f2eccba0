// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs::test {

/// Everything random of one trial: the same seed, the same trial.
class Dice {
 public:
  explicit Dice(uint64_t seed) : generator_(seed) {}

  /// From 0 to limit - 1; limit is at least 1.
  std::size_t below(std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(generator_);
  }
  bool chance(double probability) { return unit() < probability; }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(generator_); }
  double number(double limit) { return limit * (2.0 * unit() - 1.0); }
  Eigen::Vector3d vector(double limit) { return {number(limit), number(limit), number(limit)}; }

  template <typename Value>
  const Value& oneOf(const std::vector<Value>& values) {
    return values[below(values.size())];
  }

  Eigen::Vector3d direction() {
    for (;;) {
      const Eigen::Vector3d v = vector(1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }

  /// Turned little, in any way, or by half a turn but for rounding.
  Pose pose(double extent_m) {
    Tangent delta;
    const double angle =
        oneOf(std::vector<double>{0.0, 1e-9, 0.3, M_PI * unit(), M_PI, M_PI - 1e-8 * unit()});
    delta << vector(extent_m), angle * direction();
    return expPose(delta);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace mrpt_sgraphs::test
