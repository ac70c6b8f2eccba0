// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// One IMU measurement in the base frame.
struct ImuSample {
  double stamp_s = 0.0;
  Eigen::Vector3d angular_velocity_base{0.0, 0.0, 0.0};     ///< [rad/s]
  Eigen::Vector3d specific_force_base{0.0, 0.0, 0.0};       ///< [m/s^2], +9.81 upwards at rest

  template <typename Archive>
  void archive(Archive& a) {
    a("stamp_s", stamp_s);
    a("angular_velocity_base", angular_velocity_base);
    a("specific_force_base", specific_force_base);
  }
};

/// One pose of the robot's own odometry, in a frame that may drift but does not jump.
struct OdomSample {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();

  template <typename Archive>
  void archive(Archive& a) {
    a("stamp_s", stamp_s);
    a("T_odom_base", T_odom_base);
  }
};

/// The last seconds of the robot's own odometry, asked for the motion between two stamps.
class OdomBuffer {
 public:
  /// Samples out of order or not finite are dropped.
  /// @return Whether it was taken.
  bool add(const OdomSample& sample);

  /// T_base(from)_base(to), interpolated; nothing where the buffer does not cover both within 0.1 s.
  std::optional<Pose> motion(double from_s, double to_s) const;

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("samples", samples_);
  }

 private:
  std::optional<Pose> at(double stamp_s) const;

  std::deque<OdomSample> samples_;
};

/// The last seconds of a gyroscope, asked for rotations, and the direction of gravity.
class ImuBuffer {
 public:
  /// Samples out of order or not finite are dropped.
  /// @return Whether it was taken.
  bool add(const ImuSample& sample);

  /// R_base(from)_base(to) with the bias removed; nothing where samples are missing for more than
  /// 50 ms of it.
  std::optional<Eigen::Matrix3d> rotation(double from_s, double to_s) const;

  /// Rotation R_level_base that turns the mean specific force of the given time span upwards, with
  /// no turn about the vertical; nothing where there are fewer than ten samples or the force is not
  /// about one g.
  std::optional<Eigen::Matrix3d> level(double from_s, double to_s) const;

  /// What the scans say that the gyroscope has too much, folded in slowly [rad/s].
  void correctBias(const Eigen::Vector3d& excess_rad_s);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("samples", samples_);
    a("bias_rad_s", bias_rad_s_);
  }

 private:
  std::deque<ImuSample> samples_;
  Eigen::Vector3d bias_rad_s_{0.0, 0.0, 0.0};
};

}  // namespace mrpt_sgraphs
