// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/odometry.h"

#include <cmath>

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kPeriod_s = 1e-9 * Odometry::kPeriod_ns;

double yawOf(const Pose& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

Eigen::Matrix3d aboutZ(double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

Odometry::Odometry(const Trajectory& trajectory, uint64_t seed, const OdometryNoise& noise)
    : trajectory_(trajectory),
      noise_(noise),
      random_(seed, Random::Stream::kOdometry),
      scale_(1.0 + noise.scale * random_.sign()),
      yaw_rate_bias_rad_s_(noise.yaw_rate_bias_rad_s * random_.sign()),
      yaw_offset_rad_(-yawOf(trajectory.T_map_base(0.0))),
      T_map_last_(trajectory.T_map_base(0.0)) {}

OdometrySample Odometry::next() {
  const double time_s = kPeriod_s * static_cast<double>(index_);
  const Pose T_map_base = trajectory_.T_map_base(time_s);
  const Tangent step = local(T_map_last_, T_map_base);
  const Eigen::Vector3d step_map = T_map_base.translation() - T_map_last_.translation();
  const double moved_m = step_map.norm();

  const double root_moved = std::sqrt(moved_m);
  const Eigen::Vector3d noise_m(random_.gaussian(), random_.gaussian(), random_.gaussian());
  if (index_ > 0) {
    yaw_offset_rad_ +=
        yaw_rate_bias_rad_s_ * kPeriod_s +
        noise_.yaw_walk_rad * std::sqrt(moved_m + step.tail<3>().norm()) * random_.gaussian();
    position_odom_ +=
        aboutZ(yaw_offset_rad_) * (scale_ * step_map) + noise_.step_m * root_moved * noise_m;
  }
  distance_m_ += moved_m;

  const Eigen::Vector3d tilt(noise_.tilt_rad * random_.gaussian(),
                             noise_.tilt_rad * random_.gaussian(), 0.0);
  OdometrySample sample;
  sample.time_ns = index_ * kPeriod_ns;
  sample.T_odom_base.translation() = position_odom_;
  sample.T_odom_base.linear() = aboutZ(yaw_offset_rad_) * T_map_base.linear() * expSO3(tilt);
  sample.velocity_base =
      scale_ * T_map_base.linear().transpose() * trajectory_.velocity_map(time_s);
  sample.angular_velocity_base = trajectory_.angularVelocity_base(time_s);
  sample.angular_velocity_base.z() += yaw_rate_bias_rad_s_;
  sample.distance_m = distance_m_;
  T_map_last_ = T_map_base;
  ++index_;
  return sample;
}

}  // namespace mrpt_sgraphs::sim
