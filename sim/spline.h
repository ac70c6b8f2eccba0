// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace mrpt_sgraphs::sim {

/// A uniform cubic B-spline over time. It is C2, stays in the hull of any four neighbouring control
/// points, and its speed in the hull of their differences: what is within limits stays so.
template <int Dimension>
class Spline {
 public:
  using Value = Eigen::Matrix<double, Dimension, 1>;

  /// @param points    Control points; the first and last go on for ever.
  /// @param period_s  Between control points; the first is at time 0.
  Spline(std::vector<Value> points, double period_s)
      : points_(std::move(points)), period_s_(period_s) {}

  double duration_s() const { return period_s_ * static_cast<double>(points_.size() - 1); }

  Value at(double time_s) const {
    const double position = std::clamp(time_s, 0.0, duration_s()) / period_s_;
    const double f = position - std::floor(position);
    const auto k = static_cast<long>(std::floor(position));
    const double g = 1.0 - f;
    const std::array<double, 4> weights{
        g * g * g / 6.0, (3.0 * f * f * f - 6.0 * f * f + 4.0) / 6.0,
        (3.0 * g * g * g - 6.0 * g * g + 4.0) / 6.0, f * f * f / 6.0};
    Value value = Value::Zero();
    for (long j = 0; j < 4; ++j) value += weights[static_cast<size_t>(j)] * point(k - 1 + j);
    return value;
  }

 private:
  const Value& point(long k) const {
    const long last = static_cast<long>(points_.size()) - 1;
    return points_[static_cast<size_t>(std::clamp(k, 0L, last))];
  }

  std::vector<Value> points_;
  double period_s_;
};

}  // namespace mrpt_sgraphs::sim
