// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "mrpt_sgraphs/semantics/room_detector.h"
#include "mrpt_sgraphs/slam/back_end_config.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

/// What comes after the front end, on the caller's thread: each keyframe goes into the graph, and
/// then floors and rooms are looked for in it. The same input gives the same output, whether it
/// comes from the front end itself or from a recording of it: its budgets are iterations, and none
/// is wall time.
class BackEnd {
 public:
  explicit BackEnd(const BackEndConfig& config);

  /// Every scan that was placed, in their order.
  void addScan(const ScanMotion& scan, const ScanReport& report) { log_.addScan(scan, report); }

  /// After its scan.
  /// @param segment_ms  What its planes have cost.
  /// @throws std::invalid_argument as GraphSlam::addKeyframe does.
  void addKeyframe(const Keyframe& keyframe, double segment_ms);

  std::size_t scans() const { return log_.scans(); }
  GraphSnapshotConstPtr graph() const { return graph_slam_.snapshot(); }

  /// Everything so far, with the parameters of the back end, after what the stages have put off: see
  /// GraphSlam::finish. `wall_s` is the caller's to fill in.
  RunRecord record();

 private:
  BackEndConfig config_;
  GraphSlam graph_slam_;
  RoomDetector rooms_;
  RunLog log_;
};

}  // namespace mrpt_sgraphs
