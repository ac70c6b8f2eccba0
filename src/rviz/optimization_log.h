// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>

namespace mrpt_sgraphs {

/// How long the optimizations of each kind took, as far as they were heard of.
class OptimizationLog {
 public:
  struct Times {
    std::size_t count = 0;
    double last_ms = 0.0;  ///< CPU, as the others.
    double mean_ms = 0.0;
    double max_ms = 0.0;
  };

  void add(const std::string& kind, double total_ms) {
    Times& times = by_kind_[kind];
    ++times.count;
    times.last_ms = total_ms;
    times.mean_ms += (total_ms - times.mean_ms) / static_cast<double>(times.count);
    times.max_ms = std::max(times.max_ms, total_ms);
  }

  const std::map<std::string, Times>& byKind() const { return by_kind_; }

 private:
  std::map<std::string, Times> by_kind_;
};

}  // namespace mrpt_sgraphs
