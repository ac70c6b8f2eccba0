// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace mrpt_sgraphs {

/// Lets something pass at most every so often. By a steady clock: ROS_WARN_THROTTLE goes by
/// ros::Time, and says nothing while a simulated clock stands still.
class Throttle {
 public:
  explicit Throttle(double period_s = 5.0) : period_(period_s) {}

  bool passes() {
    const auto now = std::chrono::steady_clock::now();
    if (passed_before_ && now - last_ < period_) return false;
    passed_before_ = true;
    last_ = now;
    return true;
  }

 private:
  std::chrono::duration<double> period_;
  bool passed_before_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace mrpt_sgraphs
