// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/firing_order.h"

#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr std::size_t kSamples = 256;       ///< Azimuths that are looked at to find the order.
constexpr std::size_t kMinPoints = 8 * kSamples;
constexpr double kTurn_rad = 2.0 * M_PI;
constexpr double kMaxStep_rad = 0.35;       ///< Between samples; more is a jump, not a sweep.
constexpr std::size_t kMaxJumps = 6;        ///< Openings without returns.
constexpr double kMinSweep_rad = 0.75 * kTurn_rad;
constexpr double kMaxSweep_rad = 1.1 * kTurn_rad;

double azimuthOf(const Point& p) { return std::atan2(p.y, p.x); }

double wrapped(double angle_rad) { return std::remainder(angle_rad, kTurn_rad); }

}  // namespace

std::vector<float> sweepFractions(const Cloud& cloud) {
  if (cloud.size() < kMinPoints) return {};
  const double stride = static_cast<double>(cloud.size() - 1) / (kSamples - 1);
  const auto sampleIndex = [stride](std::size_t k) {
    return static_cast<std::size_t>(static_cast<double>(k) * stride);
  };
  std::vector<double> swept{0.0};  // unwrapped azimuth at the samples
  std::size_t forward = 0;
  std::size_t jumps = 0;
  for (std::size_t k = 1; k < kSamples; ++k) {
    const double step =
        wrapped(azimuthOf(cloud[sampleIndex(k)]) - azimuthOf(cloud[sampleIndex(k - 1)]));
    swept.push_back(swept.back() + step);
    forward += step > 0.0 ? 1 : 0;
    jumps += std::abs(step) > kMaxStep_rad ? 1 : 0;
  }
  const double total = swept.back();
  constexpr std::size_t kMaxAgainst = kSamples / 20;
  const std::size_t against = total > 0.0 ? kSamples - 1 - forward : forward;
  if (against > kMaxAgainst || jumps > kMaxJumps || std::abs(total) < kMinSweep_rad ||
      std::abs(total) > kMaxSweep_rad) {
    return {};
  }

  std::vector<float> fractions;
  fractions.reserve(cloud.size());
  const double start_rad = azimuthOf(cloud[0]);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double near = swept[std::min(kSamples - 1, static_cast<std::size_t>(
                                                         static_cast<double>(i) / stride))];
    const double angle = near + wrapped(azimuthOf(cloud[i]) - start_rad - near);
    fractions.push_back(static_cast<float>(angle / std::copysign(kTurn_rad, total)));
  }
  return fractions;
}

}  // namespace mrpt_sgraphs
