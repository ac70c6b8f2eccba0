// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/random.h"
#include "sim/trajectory.h"

namespace mrpt_sgraphs::sim {

/// Of a quadruped's odometry, which sees gravity: roll and pitch do not drift. Together they drift
/// by one to two percent of the distance and a few degrees over some minutes.
struct OdometryNoise {
  double scale = 0.01;                  ///< Distances come out longer or shorter by this.
  double yaw_rate_bias_rad_s = 3.5e-4;  ///< Either way; a good degree per minute.
  double yaw_walk_rad = 4e-3;           ///< Per square root of a metre walked or radian turned.
  double step_m = 0.02;                 ///< Per square root of a metre, along each axis.
  double tilt_rad = 0.002;              ///< Of roll and pitch, at each sample.
};

struct OdometrySample {
  int64_t time_ns = 0;  ///< Since the start.
  Pose T_odom_base = Pose::Identity();
  Eigen::Vector3d velocity_base = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d angular_velocity_base = Eigen::Vector3d::Zero();  ///< [rad/s]
  double distance_m = 0.0;  ///< Walked so far, what its uncertainty grows with.
};

/// Dead reckoning: the increments of the true motion, with errors that add up. The frame `odom` has
/// its origin on base_link at the start, level, its x axis forward.
class Odometry {
 public:
  static constexpr int64_t kPeriod_ns = 50'000'000;

  /// Keeps a reference to the trajectory.
  Odometry(const Trajectory& trajectory, uint64_t seed,
           const OdometryNoise& noise = OdometryNoise{});

  /// The next sample; the first is at the start.
  OdometrySample next();

  const OdometryNoise& noise() const { return noise_; }

 private:
  const Trajectory& trajectory_;
  OdometryNoise noise_;
  Random random_;
  double scale_;
  double yaw_rate_bias_rad_s_;
  double yaw_offset_rad_;  ///< From map to odom, as believed.
  Eigen::Vector3d position_odom_ = Eigen::Vector3d::Zero();
  Pose T_map_last_;
  double distance_m_ = 0.0;
  int64_t index_ = 0;
};

}  // namespace mrpt_sgraphs::sim
