// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/odometry.h"
#include "mrpt_sgraphs/frontend/plane_observer.h"
#include "mrpt_sgraphs/frontend/prefilter.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/semantics/room_detector.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/scan_trajectory.h"
#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {

/// The classes of the nodelets, one after the other on the caller's thread: the same input gives the
/// same output.
class Pipeline {
 public:
  explicit Pipeline(const SlamConfig& config);

  void addImu(const ImuSample& sample) { odometry_.addImu(sample); }
  void addOdom(const OdomSample& sample) { odometry_.addOdom(sample); }

  /// Takes a scan through all of the pipeline. What happens within its sweep should have been added
  /// before: IMU and odometry up to its last point.
  /// @return What is to be said of it, with numbers; empty if all is well. A scan that cannot be used
  ///         at all is not in the record.
  std::string addScan(const RawCloud& raw, const Pose& T_base_lidar, const std::string& base_frame);

  std::size_t scans() const { return trajectory_.odometry().size(); }
  GraphSnapshotConstPtr graph() const { return graph_slam_.snapshot(); }

  /// Everything so far. Durations are the caller's to fill in.
  RunRecord record();

 private:
  void add(const std::vector<OptimizationSummary>& optimizations);

  SlamConfig config_;
  Prefilter prefilter_;
  Odometry odometry_;
  KeyframeSelector keyframes_;
  PlaneObserver planes_;
  GraphSlam graph_slam_;
  RoomDetector rooms_;
  ScanTrajectory trajectory_;
  std::vector<OptimizationSummary> optimizations_;
  std::vector<ScanReport> scans_;
};

}  // namespace mrpt_sgraphs
