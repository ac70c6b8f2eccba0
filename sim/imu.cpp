// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/imu.h"

#include <cmath>

namespace mrpt_sgraphs::sim {

Imu::Imu(const Trajectory& trajectory, uint64_t seed, const ImuNoise& noise)
    : trajectory_(trajectory),
      noise_(noise),
      random_(seed, Random::Stream::kImu),
      gyro_bias_(gaussian(noise.gyro_bias_rad_s)),
      accelerometer_bias_(gaussian(noise.accelerometer_bias_m_s2)) {}

Eigen::Vector3d Imu::gaussian(double sigma) {
  const double x = random_.gaussian();
  const double y = random_.gaussian();
  const double z = random_.gaussian();
  return sigma * Eigen::Vector3d(x, y, z);
}

ImuSample Imu::sample(int64_t index) {
  constexpr double kPeriod_s = 1e-9 * kPeriod_ns;
  const double root_period = std::sqrt(kPeriod_s);
  gyro_bias_ += gaussian(noise_.gyro_bias_walk_rad_s * root_period);
  accelerometer_bias_ += gaussian(noise_.accelerometer_bias_walk_m_s2 * root_period);

  const double time_s = kPeriod_s * static_cast<double>(index);
  const Eigen::Matrix3d R_base_map = trajectory_.T_map_base(time_s).linear().transpose();
  const Eigen::Vector3d up = kGravity_m_s2 * Eigen::Vector3d::UnitZ();
  ImuSample sample;
  sample.time_ns = index * kPeriod_ns;
  sample.angular_velocity_base =
      trajectory_.angularVelocity_base(time_s) + gyro_bias_ + gaussian(noise_.gyro_rad_s);
  sample.acceleration_base = R_base_map * (trajectory_.acceleration_map(time_s) + up) +
                             accelerometer_bias_ + gaussian(noise_.accelerometer_m_s2);
  return sample;
}

}  // namespace mrpt_sgraphs::sim
