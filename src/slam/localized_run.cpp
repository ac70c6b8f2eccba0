// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/localized_run.h"

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/geometry/resident_memory.h"

namespace mrpt_sgraphs {

void LocalizedRun::addScan(const ScanMotion& scan, const ScanReport& report) {
  log_.addScan(scan, report);
  if (last_scan_) {
    way_m_ += (scan.T_odom_base.translation() - last_scan_->T_odom_base.translation()).norm();
  }
  last_scan_ = scan;
  if (const auto T_map_odom = localization_.T_map_odom()) {
    trajectory_.push_back({scan.stamp_s, orthonormalized(*T_map_odom * scan.T_odom_base)});
  }
}

void LocalizedRun::addKeyframe(const Keyframe& keyframe, double segment_ms) {
  CpuStopwatch watch;
  const bool was_localized = localization_.status().localized;
  const LocalizationStatus& status = localization_.addKeyframe(keyframe);
  if (was_localized && !status.localized) ++report_.losses;
  if (status.localized && !report_.first_after_s && !log_.trajectory().odometry().empty()) {
    report_.first_after_s = keyframe.stamp_s - log_.trajectory().odometry().front().stamp_s;
    report_.first_after_m = way_m_;
  }
  ScanReport* const report = log_.report(keyframe.stamp_s);
  if (report == nullptr) return;
  report->keyframe = true;
  report->segment_ms = segment_ms;
  report->keyframe_ms = watch.lap();
  report->rss_mib = residentMemory_MiB();
}

RunRecord LocalizedRun::record() const {
  RunRecord run = log_.record(localization_.map());
  run.trajectory = trajectory_;
  run.localization = report_;
  run.localization->localized = localization_.status().localized;
  run.localization->problem = localization_.status().problem;
  run.localization->relocations = localization_.status().relocations;
  return run;
}

}  // namespace mrpt_sgraphs
