// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace mrpt_sgraphs {

/// How long optimizations took [ms of CPU]; NaN where there was none.
struct TimeStatistics {
  std::size_t count = 0;
  double mean_ms = 0.0;
  double p50_ms = 0.0;
  double p95_ms = 0.0;
  double max_ms = 0.0;
};

TimeStatistics timeStatistics(const std::vector<double>& times_ms);

/// Of a run: its mean over all kinds is the paper's quantity.
struct OptimizationTimes {
  TimeStatistics all;
  std::map<std::string, TimeStatistics> by_kind;
};

/// Reads the columns `kind` and `total_ms` of an optimizations.csv, wherever they stand.
/// @throws std::runtime_error naming the file, and the line or the missing column.
OptimizationTimes readOptimizationTimes(const std::string& path);

}  // namespace mrpt_sgraphs
