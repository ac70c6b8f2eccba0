// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <unistd.h>

#include <fstream>

namespace mrpt_sgraphs {

/// Of this program, now [MiB]; 0 where the system does not tell.
inline double residentMemory_MiB() {
  constexpr double kBytesInMiB = 1024.0 * 1024.0;
  std::ifstream statm("/proc/self/statm");
  double pages_in_all = 0.0;
  double resident_pages = 0.0;
  if (!(statm >> pages_in_all >> resident_pages)) return 0.0;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / kBytesInMiB;
}

}  // namespace mrpt_sgraphs
