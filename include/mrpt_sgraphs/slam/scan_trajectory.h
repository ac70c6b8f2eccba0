// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs {

/// Where every scan was, by odometry and after the last optimization.
class ScanTrajectory {
 public:
  void add(double stamp_s, const Pose& T_odom_base) { odometry_.push_back({stamp_s, T_odom_base}); }

  /// The next scan is the first of another session: odometry begins again, and there is no way
  /// from what was before.
  void beginSession() { sessions_.push_back(odometry_.size()); }

  /// One line a scan, as the front end alone said: T_odom_base.
  const Trajectory& odometry() const { return odometry_; }

  /// Of all sessions, without the time between them.
  double duration_s() const;

  /// One line a scan, T_map_base: the drift found at the keyframes before and after it, shared out
  /// by time; past the last keyframe that one's.
  Trajectory corrected(const GraphSnapshot& graph) const;

  template <typename Archive>
  void archive(Archive& a) {
    a("odometry", odometry_);
    a("sessions", sessions_);
  }

 private:
  Trajectory odometry_;
  std::vector<std::size_t> sessions_;  ///< The first scan of each but the first one.
};

}  // namespace mrpt_sgraphs
