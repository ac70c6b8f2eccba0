// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/run_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mrpt_sgraphs/geometry/archive_geometry.h"

namespace mrpt_sgraphs {

void RunLog::addScan(const ScanMotion& scan, const ScanReport& report) {
  trajectory_.add(scan.stamp_s, scan.T_odom_base);
  scans_.push_back(report);
}

void RunLog::add(const std::vector<OptimizationSummary>& optimizations) {
  optimizations_.insert(optimizations_.end(), optimizations.begin(), optimizations.end());
}

void RunLog::append(const RunLog& later) {
  const double end_s = stamp_s().value_or(-std::numeric_limits<double>::infinity());
  const Trajectory& odometry = later.trajectory_.odometry();
  for (std::size_t k = 0; k < odometry.size(); ++k) {
    if (odometry[k].stamp_s <= end_s) continue;
    trajectory_.add(odometry[k].stamp_s, odometry[k].T_world_body);
    scans_.push_back(later.scans_[k]);
  }
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
  run.data_s = trajectory_.duration_s();
  return run;
}

template <typename Archive>
void part(Archive& a, StampedPose& stamped) {
  a.item(stamped.stamp_s);
  a.item(stamped.T_world_body);
}

template <typename Archive>
void part(Archive& a, ScanReport& r) {
  for (double* value : {&r.stamp_s, &r.prefilter_ms, &r.deskew_ms, &r.register_ms, &r.map_ms,
                        &r.select_ms, &r.segment_ms, &r.keyframe_ms, &r.rooms_ms, &r.rss_mib}) {
    a.item(*value);
  }
  a.item(r.registered);
  a.item(r.keyframe);
}

template <typename Archive>
void part(Archive& a, OptimizationSummary& r) {
  a("stamp_s", r.stamp_s);
  a("kind", r.kind);
  a("mode", r.mode);
  a("room", r.room);
  for (int* value :
       {&r.keyframes_active, &r.keyframes_marginalized, &r.dropped, &r.walls, &r.rooms, &r.floors,
        &r.factors, &r.free_variables, &r.iterations}) {
    a.item(*value);
  }
  a("free_keyframes", r.free_keyframes);
  a("fixed_keyframes", r.fixed_keyframes);
  a("cost_before", r.cost_before);
  a("cost_after", r.cost_after);
  a("converged", r.converged);
  a("problem", r.problem);
  for (double* value : {&r.total_ms, &r.linearize_ms, &r.factorize_ms}) a.item(*value);
}

template <typename Archive>
void RunLog::archive(Archive& a) {
  a("trajectory", trajectory_);
  a("optimizations", optimizations_);
  a("scans", scans_);
}

template void RunLog::archive(ArchiveWriter&);
template void RunLog::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
