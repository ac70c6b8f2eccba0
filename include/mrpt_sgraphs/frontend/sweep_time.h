// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

namespace mrpt_sgraphs {

/// How the per-point times of a scan are to be read: seconds from the header stamp are
/// (value - origin) * unit_s.
struct SweepTimes {
  bool usable = false;
  double origin = 0.0;
  double unit_s = 1.0;
  std::string remark;  ///< Why they are not usable, or what was assumed; empty if all is plain.
};

/// Finds unit and origin of per-point times whatever the driver writes: float seconds, integer
/// nanoseconds or microseconds, from the stamp on or from an epoch.
///
/// The unit is the coarsest of s, ms, us and ns in which the scan lasts at most two seconds. Times
/// near zero count from the stamp; others from an epoch, the stamp's own if they agree with it
/// within two seconds, else the first point is taken to be at the stamp.
///
/// @param values    As sent. All equal means that there are none.
/// @param integers  Integer fields are never in seconds.
SweepTimes sweepTimes(const std::vector<double>& values, double stamp_s, bool integers);

}  // namespace mrpt_sgraphs
