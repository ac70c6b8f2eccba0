// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/run_log.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {

void RunLog::addScan(const ScanMotion& scan, const ScanReport& report) {
  trajectory_.add(scan.stamp_s, scan.T_odom_base);
  scans_.push_back(report);
}

void RunLog::add(const std::vector<OptimizationSummary>& optimizations) {
  optimizations_.insert(optimizations_.end(), optimizations.begin(), optimizations.end());
}

ScanReport* RunLog::report(double stamp_s) {
  constexpr double kSameStamp_s = 1e-6;
  const auto scan =
      std::find_if(scans_.rbegin(), scans_.rend(), [stamp_s](const ScanReport& report) {
        return std::abs(report.stamp_s - stamp_s) < kSameStamp_s;
      });
  return scan == scans_.rend() ? nullptr : &*scan;
}

RunRecord RunLog::record(const GraphSnapshotConstPtr& graph) const {
  RunRecord run;
  run.graph = graph;
  run.trajectory = trajectory_.corrected(*graph);
  run.odometry = trajectory_.odometry();
  run.optimizations = optimizations_;
  run.scans = scans_;
  if (!scans_.empty()) run.data_s = scans_.back().stamp_s - scans_.front().stamp_s;
  return run;
}

}  // namespace mrpt_sgraphs
