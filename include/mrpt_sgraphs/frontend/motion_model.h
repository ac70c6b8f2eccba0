// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/frontend/motion_buffers.h"
#include "mrpt_sgraphs/frontend/registration.h"

namespace mrpt_sgraphs {

/// How a robot moves, and how far its other sensors are believed.
struct MotionModelConfig {
  double max_acceleration_m_s2 = 3.0;            ///< How wrong a constant velocity may be.
  double max_angular_acceleration_rad_s2 = 8.0;  ///< The same for turning.
  double odom_in_sigma_m_per_m = 0.05;           ///< Error of the robot's odometry over a distance
  double odom_in_sigma_rad_per_m = 0.02;         ///< and of its heading.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("max_acceleration_m_s2", self.max_acceleration_m_s2, 0.1, 100.0);
    field("max_angular_acceleration_rad_s2", self.max_angular_acceleration_rad_s2, 0.1, 1000.0);
    field("odom_in_sigma_m_per_m", self.odom_in_sigma_m_per_m, 1e-4, 1.0);
    field("odom_in_sigma_rad_per_m", self.odom_in_sigma_rad_per_m, 1e-4, 1.0);
  }
};

/// What is known of the motion after a scan.
struct MotionState {
  double stamp_s = 0.0;
  double seen_until_s = 0.0;  ///< The end of the sweep, whose motion the scan has shown itself.
  MovingPose mean;
  Matrix12 covariance = Matrix12::Zero();  ///< Of pose and velocity, right perturbation.

  template <typename Archive>
  void archive(Archive& a) {
    a("stamp_s", stamp_s);
    a("seen_until_s", seen_until_s);
    a("mean", mean);
    a("covariance", covariance);
  }
};

/// A robot at a place, moving in a way that is not known yet.
MotionState startingMotion(double stamp_s, const Pose& T_odom_base);

/// Predicts the next scan's pose and velocity as a Kalman filter does: constant velocity with a noise
/// that follows from the largest acceleration, the gyroscope's turning and the robot's own odometry
/// where they cover the time between the scans.
/// @param gyro_in_sweep  The turning within the scan is known: its velocity is then what the
///                       gyroscope has wrong.
MotionPrior predictMotion(const MotionState& last, double stamp_s, bool gyro_in_sweep,
                          const ImuBuffer& imu, const OdomBuffer& odom_in,
                          const MotionModelConfig& config);

/// A prior that knows little more than that the robot is thereabouts: scans were lost, stamps lie,
/// or it was pushed.
MotionPrior ignorantAround(const MovingPose& pose);

/// Of the pose, whatever the velocity is.
Matrix6 covarianceOfPose(const MotionPrior& prior);

}  // namespace mrpt_sgraphs
