// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <ctime>

namespace mrpt_sgraphs {

/// CPU time of the calling thread [ms]: what reports are made of, since wall time measures the
/// machine's other guests.
inline double threadCpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Milliseconds of CPU since the last lap, or since it was made.
class CpuStopwatch {
 public:
  double lap() {
    const double now_ms = threadCpuMilliseconds();
    const double lap_ms = now_ms - last_ms_;
    last_ms_ = now_ms;
    return lap_ms;
  }

 private:
  double last_ms_ = threadCpuMilliseconds();
};

}  // namespace mrpt_sgraphs
