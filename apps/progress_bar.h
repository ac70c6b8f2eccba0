// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace mrpt_sgraphs {

/// A bar that is drawn over itself, on a terminal only.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) == 1) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param done  0 to 1.
  void show(double done) {
    const int percent = static_cast<int>(100.0 * std::clamp(done, 0.0, 1.0));
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    constexpr int kWidth = 40;
    const std::string filled(static_cast<std::size_t>(percent * kWidth / 100), '=');
    std::fprintf(stderr, "\r[%-*s] %3d %%", kWidth, filled.c_str(), percent);
  }

  /// Makes room for a line of text.
  void clear() {
    if (percent_ >= 0) std::fprintf(stderr, "\r\033[K");
    percent_ = -1;
  }

 private:
  bool shown_;
  int percent_ = -1;
};

}  // namespace mrpt_sgraphs
