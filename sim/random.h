// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace mrpt_sgraphs::sim {

/// Everything random comes from here. One seed gives the whole run; each sensor has its own stream
/// of it, so that another lidar does not change the odometry.
///
/// The distributions are our own, because those of <random> may differ between standard libraries.
class Random {
 public:
  enum class Stream : uint32_t { kLidar = 1, kOdometry = 2, kImu = 3 };

  Random(uint64_t seed, Stream stream) {
    std::seed_seq words{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32),
                        static_cast<uint32_t>(stream)};
    engine_.seed(words);
  }

  /// In [0, 1).
  double uniform() {
    constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53, the spacing of doubles below 1
    return static_cast<double>(engine_() >> 11) * kUnit;
  }

  /// Mean 0, deviation 1 (Marsaglia's polar method).
  double gaussian() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0.0;
    double v = 0.0;
    double s = 0.0;
    do {
      u = 2.0 * uniform() - 1.0;
      v = 2.0 * uniform() - 1.0;
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double scale = std::sqrt(-2.0 * std::log(s) / s);
    spare_ = v * scale;
    has_spare_ = true;
    return u * scale;
  }

  /// +1 or -1.
  double sign() { return uniform() < 0.5 ? -1.0 : 1.0; }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace mrpt_sgraphs::sim
