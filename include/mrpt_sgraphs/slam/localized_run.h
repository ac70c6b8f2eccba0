// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mrpt_sgraphs/slam/localization.h"
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

/// A run that uses a map and leaves it as it is.
class LocalizedRun {
 public:
  LocalizedRun(const GraphSnapshotConstPtr& map, const BackEndConfig& config)
      : localization_(map, config) {}

  /// Every scan that was placed, in their order. Its place in the map is the one that was known when
  /// it came.
  void addScan(const ScanMotion& scan, const ScanReport& report);

  /// After its scan. @throws std::invalid_argument as Localization does.
  void addKeyframe(const Keyframe& keyframe, double segment_ms);

  const RunLog& log() const { return log_; }

  /// Its trajectory has the scans that came while the place was known; it has no state, as there is
  /// nothing to go on from. Parameters and `wall_s` are the caller's to fill in.
  RunRecord record() const;

 private:
  Localization localization_;
  RunLog log_;
  Trajectory trajectory_;
  LocalizationReport report_;
  std::optional<ScanMotion> last_scan_;
  double way_m_ = 0.0;
};

}  // namespace mrpt_sgraphs
