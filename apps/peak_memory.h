// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>

namespace mrpt_sgraphs {

/// The most memory that this program has had [MiB]. getrusage will not do: what it says includes the
/// program that started this one. 0 where the system does not tell.
inline double peakMemory_MiB() {
  constexpr double kKiBInMiB = 1024.0;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes / kKiBInMiB;
  }
  return 0.0;
}

}  // namespace mrpt_sgraphs
