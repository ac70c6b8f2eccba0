// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/scan_trajectory.h"

#include <algorithm>

namespace mrpt_sgraphs {

Trajectory ScanTrajectory::corrected(const GraphSnapshot& graph) const {
  Trajectory trajectory = odometry_;
  if (graph.keyframes.empty()) return trajectory;
  for (StampedPose& scan : trajectory) {
    const auto after = std::lower_bound(
        graph.keyframes.begin(), graph.keyframes.end(), scan.stamp_s,
        [](const KeyframeNode& keyframe, double stamp_s) { return keyframe.stamp_s < stamp_s; });
    const KeyframeNode& next = after == graph.keyframes.end() ? graph.keyframes.back() : *after;
    const KeyframeNode& last = after == graph.keyframes.begin() ? next : *std::prev(after);
    // both keyframes say where the scan was; the truth is taken to lie between
    const Pose by_last = last.T_map_base * last.T_odom_base.inverse() * scan.T_world_body;
    const Pose by_next = next.T_map_base * next.T_odom_base.inverse() * scan.T_world_body;
    const double span_s = next.stamp_s - last.stamp_s;
    const double s = span_s > 0.0 ? std::clamp((scan.stamp_s - last.stamp_s) / span_s, 0.0, 1.0) : 0.0;
    scan.T_world_body = orthonormalized(interpolate(by_last, by_next, s));
  }
  return trajectory;
}

}  // namespace mrpt_sgraphs
