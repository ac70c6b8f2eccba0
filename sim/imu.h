// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/random.h"
#include "sim/trajectory.h"

namespace mrpt_sgraphs::sim {

constexpr double kGravity_m_s2 = 9.80665;

/// Of a good MEMS unit, for each axis. Noise is that of one sample at 100 Hz.
struct ImuNoise {
  double gyro_rad_s = 0.002;
  double gyro_bias_rad_s = 0.002;      ///< At the start, a deviation.
  double gyro_bias_walk_rad_s = 2e-5;  ///< Per square root of a second.
  double accelerometer_m_s2 = 0.02;
  double accelerometer_bias_m_s2 = 0.03;
  double accelerometer_bias_walk_m_s2 = 5e-4;
};

struct ImuSample {
  int64_t time_ns = 0;                                              ///< Since the start.
  Eigen::Vector3d angular_velocity_base = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector3d acceleration_base = Eigen::Vector3d::Zero();      ///< [m/s^2], +g up at rest.
};

/// An IMU at base_link: gyroscope and accelerometer with white noise and slowly walking biases.
class Imu {
 public:
  static constexpr int64_t kPeriod_ns = 10'000'000;

  /// Keeps a reference to the trajectory.
  Imu(const Trajectory& trajectory, uint64_t seed, const ImuNoise& noise = ImuNoise{});

  /// To be called with rising indices: the biases walk from sample to sample.
  ImuSample sample(int64_t index);

  const ImuNoise& noise() const { return noise_; }

 private:
  Eigen::Vector3d gaussian(double sigma);

  const Trajectory& trajectory_;
  ImuNoise noise_;
  Random random_;
  Eigen::Vector3d gyro_bias_;
  Eigen::Vector3d accelerometer_bias_;
};

}  // namespace mrpt_sgraphs::sim
