// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/frontend/keyframe_selector.h"

namespace mrpt_sgraphs {

/// Makes good odometry drift, to see what a back end makes of it: with every metre of the way the
/// heading turns by so much too far. Keyframes say honestly how uncertain their motion is then.
class OdometryDrift {
 public:
  /// @param rad_per_m  Zero: everything stays as it is, to the last bit.
  explicit OdometryDrift(double rad_per_m) : rad_per_m_(rad_per_m) {}

  /// Every scan, in their order.
  void apply(ScanMotion* scan) {
    if (rad_per_m_ == 0.0) return;
    if (has_last_) {
      const Pose step = last_.inverse() * scan->T_odom_base;
      const double way_m = step.translation().norm();
      way_since_keyframe_m_ += way_m;
      drifted_ = orthonormalized(drifted_ * step * turn(rad_per_m_ * way_m));
    } else {
      drifted_ = scan->T_odom_base;
      has_last_ = true;
    }
    last_ = scan->T_odom_base;
    scan->T_odom_base = drifted_;
  }

  /// A keyframe, after its scan.
  void apply(Keyframe* keyframe) {
    if (rad_per_m_ == 0.0) return;
    keyframe->T_odom_base = drifted_;
    const double sigma_rad = rad_per_m_ * way_since_keyframe_m_;
    keyframe->covariance(5, 5) += sigma_rad * sigma_rad;
    way_since_keyframe_m_ = 0.0;
  }

 private:
  static Pose turn(double angle_rad) {
    Pose T = Pose::Identity();
    T.linear() = expSO3({0.0, 0.0, angle_rad});
    return T;
  }

  double rad_per_m_;
  bool has_last_ = false;
  Pose last_ = Pose::Identity();
  Pose drifted_ = Pose::Identity();
  double way_since_keyframe_m_ = 0.0;
};

}  // namespace mrpt_sgraphs
