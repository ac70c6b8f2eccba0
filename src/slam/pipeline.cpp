// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/pipeline.h"

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/slam/config_file.h"

namespace mrpt_sgraphs {

Pipeline::Pipeline(const SlamConfig& config)
    : config_(config),
      prefilter_(config.prefilter),
      odometry_(config.odometry),
      keyframes_(config.keyframes),
      planes_(config.plane_segmentation),
      graph_slam_(config),
      rooms_(config.room_detection) {}

std::string Pipeline::addScan(const RawCloud& raw, const Pose& T_base_lidar,
                              const std::string& base_frame) {
  CpuStopwatch watch;
  const PrefilterResult scan = prefilter_.filter(raw, T_base_lidar, base_frame);
  if (scan.cloud == nullptr) return scan.problem;
  ScanReport report;
  report.prefilter_ms = watch.lap();

  const std::optional<OdometryResult> odometry = odometry_.process(*scan.cloud);
  if (!odometry) {
    return "its stamp " + std::to_string(stampOf(*scan.cloud)) +
           " is not newer than that of the scan before it; left out";
  }
  report.stamp_s = odometry->stamp_s;
  report.deskew_ms = odometry->deskew_ms;
  report.register_ms = odometry->register_ms;
  report.map_ms = odometry->map_ms;
  report.registered = odometry->registered;
  trajectory_.add(odometry->stamp_s, odometry->T_odom_base);
  watch.lap();

  planes_.addScan(odometry->deskewed, odometry->T_odom_base, odometry->registered);
  auto keyframe = keyframes_.process(
      {odometry->stamp_s, odometry->T_odom_base, odometry->covariance}, *odometry->deskewed);
  report.keyframe_ms = watch.lap();
  if (keyframe) {
    keyframe->planes = planes_.take();
    report.segment_ms = watch.lap();
    add(graph_slam_.addKeyframe(*keyframe).optimizations);
    if (config_.floors.enabled) {
      add(graph_slam_.setFloors(detectFloors(*graph_slam_.snapshot(), config_.floors)));
    }
    report.keyframe = true;
    report.keyframe_ms += watch.lap();
    if (config_.room_detection.enabled) {
      const RoomDetection rooms = rooms_.detect(*graph_slam_.snapshot());
      report.rooms_ms = watch.lap();
      add(graph_slam_.setRooms(rooms));
      report.keyframe_ms += watch.lap();
    }
  }
  scans_.push_back(report);
  return odometry->problem.empty() ? scan.remark : odometry->problem;
}

void Pipeline::add(const std::vector<OptimizationSummary>& optimizations) {
  optimizations_.insert(optimizations_.end(), optimizations.begin(), optimizations.end());
}

RunRecord Pipeline::record() {
  add(graph_slam_.finish());
  RunRecord run;
  run.graph = graph_slam_.snapshot();
  run.trajectory = trajectory_.corrected(*run.graph);
  run.odometry = trajectory_.odometry();
  run.optimizations = optimizations_;
  run.scans = scans_;
  run.parameters = parameterList(config_);
  return run;
}

}  // namespace mrpt_sgraphs
