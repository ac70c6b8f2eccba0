// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace mrpt_sgraphs {

/// Tells a scan that comes late or twice from a source that started again, such as a looped bag.
class StampOrder {
 public:
  enum class Verdict { kNext, kNotNewer, kStartedAgain };

  Verdict check(double stamp_s) {
    const bool first = !last_s_;
    if (!first && stamp_s <= *last_s_ && stamp_s >= *last_s_ - kRestart_s) {
      return Verdict::kNotNewer;
    }
    const bool again = !first && stamp_s < *last_s_;
    last_s_ = stamp_s;
    return again ? Verdict::kStartedAgain : Verdict::kNext;
  }

  double last_s() const { return last_s_.value_or(0.0); }

 private:
  /// Messages overtake each other by less, and no bag worth looping is shorter.
  static constexpr double kRestart_s = 1.0;

  std::optional<double> last_s_;
};

}  // namespace mrpt_sgraphs
