// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/scan_trajectory.h"

#include <algorithm>

namespace mrpt_sgraphs {

namespace {

using Keyframes = SharedVector<KeyframeNode>;

/// The place of the first keyframe not before a stamp.
std::size_t firstFrom(const Keyframes& keyframes, double stamp_s) {
  const auto found = std::lower_bound(
      keyframes.begin(), keyframes.end(), stamp_s,
      [](const KeyframeNode& keyframe, double stamp) { return keyframe.stamp_s < stamp; });
  return static_cast<std::size_t>(found - keyframes.begin());
}

/// @param first, end  Places of the keyframes of the same session.
Pose corrected(const StampedPose& scan, const Keyframes& keyframes, std::size_t first,
               std::size_t end) {
  const std::size_t after = std::clamp(firstFrom(keyframes, scan.stamp_s), first, end);
  const KeyframeNode& next = keyframes[after == end ? end - 1 : after];
  const KeyframeNode& last = after == first ? next : keyframes[after - 1];
  // both keyframes say where the scan was; the truth is taken to lie between
  const Pose by_last = last.T_map_base * last.T_odom_base.inverse() * scan.T_world_body;
  const Pose by_next = next.T_map_base * next.T_odom_base.inverse() * scan.T_world_body;
  const double span_s = next.stamp_s - last.stamp_s;
  const double s = span_s > 0.0 ? std::clamp((scan.stamp_s - last.stamp_s) / span_s, 0.0, 1.0) : 0.0;
  return orthonormalized(interpolate(by_last, by_next, s));
}

}  // namespace

double ScanTrajectory::duration_s() const {
  double duration_s = 0.0;
  for (std::size_t session = 0; session <= sessions_.size(); ++session) {
    const std::size_t begin = session == 0 ? 0 : sessions_[session - 1];
    const std::size_t end = session == sessions_.size() ? odometry_.size() : sessions_[session];
    if (begin < end) duration_s += odometry_[end - 1].stamp_s - odometry_[begin].stamp_s;
  }
  return duration_s;
}

Trajectory ScanTrajectory::corrected(const GraphSnapshot& graph) const {
  Trajectory trajectory = odometry_;
  for (std::size_t session = 0; session <= sessions_.size(); ++session) {
    const std::size_t begin = session == 0 ? 0 : sessions_[session - 1];
    const bool is_last = session == sessions_.size();
    const std::size_t end = is_last ? trajectory.size() : sessions_[session];
    if (begin == end) continue;
    const std::size_t first_keyframe = firstFrom(graph.keyframes, trajectory[begin].stamp_s);
    const std::size_t end_keyframe =
        is_last ? graph.keyframes.size() : firstFrom(graph.keyframes, trajectory[end].stamp_s);
    if (first_keyframe == end_keyframe) continue;
    for (std::size_t k = begin; k < end; ++k) {
      trajectory[k].T_world_body =
          mrpt_sgraphs::corrected(trajectory[k], graph.keyframes, first_keyframe, end_keyframe);
    }
  }
  return trajectory;
}

}  // namespace mrpt_sgraphs
