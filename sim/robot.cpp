// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/robot.h"

#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kRadPerDeg = M_PI / 180.0;
constexpr double kLidarForward_m = 0.1;

/// A quadruped of Spot's size at a walk: 3 cm between its highest and lowest.
Robot legged() {
  Robot robot;
  robot.name = "legged";
  robot.base_height_m = 0.35;
  robot.lidar_height_m = 0.35;
  robot.slope_pitch = 0.6;
  robot.climbs_stairs = true;
  robot.gait.stride_hz = 0.9;
  robot.gait.bob_m = 0.016;
  robot.gait.sway_m = 0.010;
  robot.gait.roll_rad = 1.2 * kRadPerDeg;
  robot.gait.pitch_rad = 1.0 * kRadPerDeg;
  robot.gait.yaw_rad = 0.8 * kRadPerDeg;
  return robot;
}

/// Small hard wheels on a good floor; base_link lies on the floor.
Robot wheeled() {
  Robot robot;
  robot.name = "wheeled";
  robot.lidar_height_m = 0.65;
  robot.gait.stride_hz = 7.0;
  robot.gait.bob_m = 0.0001;
  robot.gait.roll_rad = 0.04 * kRadPerDeg;
  robot.gait.pitch_rad = 0.04 * kRadPerDeg;
  return robot;
}

}  // namespace

Pose Robot::T_base_lidar(double pitch_rad) const {
  Pose T = Pose::Identity();
  T.translation() << kLidarForward_m, 0.0, lidar_height_m;
  T.linear() = Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return T;
}

Robot robotNamed(const std::string& name) {
  if (name == "legged") return legged();
  if (name == "wheeled") return wheeled();
  throw std::invalid_argument("there is no gait '" + name + "'; known are legged, wheeled");
}

}  // namespace mrpt_sgraphs::sim
