// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>
#include <string>

namespace mrpt_sgraphs {

/// Lets a warning of one kind pass at most every so often; warnings are of one kind if they differ
/// in their digits alone. By a steady clock: ROS_WARN_THROTTLE goes by ros::Time, and says nothing
/// while a simulated clock stands still.
class Throttle {
 public:
  explicit Throttle(double period_s = 5.0) : period_(period_s) {}

  bool passes(std::string warning = {}) {
    warning.erase(std::remove_if(warning.begin(), warning.end(),
                                 [](unsigned char c) { return std::isdigit(c) != 0; }),
                  warning.end());
    const auto now = Clock::now();
    const auto passed = last_.find(warning);
    if (passed != last_.end() && now - passed->second < period_) return false;
    if (last_.size() >= kMaxKinds) last_.clear();
    last_[warning] = now;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxKinds =
      100;  ///< Text of others can be in them: no end of kinds.

  std::chrono::duration<double> period_;
  std::map<std::string, Clock::time_point> last_;
};

}  // namespace mrpt_sgraphs
