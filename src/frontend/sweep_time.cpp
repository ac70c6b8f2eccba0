// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/sweep_time.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr double kLongestSweep_s = 2.0;
constexpr double kShortestSweep_s = 1e-3;  ///< Shorter than any LiDAR's: a wrong unit or no times.

}  // namespace

SweepTimes sweepTimes(const std::vector<double>& values, double stamp_s, bool integers) {
  SweepTimes result;
  const auto [first, last] = std::minmax_element(values.begin(), values.end());
  if (first == values.end() || *first == *last) return result;
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    result.remark = "not finite, the scan is not deskewed";
    return result;
  }

  const double span = *last - *first;
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (integers && unit_s == 1.0) continue;
    if (span * unit_s > kLongestSweep_s) continue;
    result.unit_s = unit_s;
    result.usable = span * unit_s >= kShortestSweep_s;
    break;
  }
  if (!result.usable) {
    result.remark = "spans " + std::to_string(span) +
                    ", which is no sweep in any unit; the scan is not deskewed";
    return result;
  }
  const auto nearZero = [&](double value) {
    return std::abs(value * result.unit_s) <= kLongestSweep_s;
  };
  if (nearZero(*first) && nearZero(*last)) return result;
  result.origin = stamp_s / result.unit_s;
  if (nearZero(*first - result.origin) && nearZero(*last - result.origin)) return result;
  result.origin = *first;
  result.remark = "counts from another clock than the header stamp; the first point is taken to be at it";
  return result;
}

}  // namespace mrpt_sgraphs
