// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/trajectory.h"

#include <cmath>
#include <stdexcept>

#include "sim/floor_plan.h"
#include "sim/tour.h"

namespace mrpt_sgraphs::sim {
namespace {

/// Half the step of central differences: their error is below 1e-5 m/s^2 for a gait of 2 Hz, and
/// rounding below 1e-7.
constexpr double kStep_s = 1e-3;

std::vector<Eigen::Matrix<double, 6, 1>> controlPoints(const std::vector<MotionState>& states,
                                                       const Robot& robot) {
  std::vector<Eigen::Matrix<double, 6, 1>> points;
  for (const MotionState& state : states) {
    Eigen::Matrix<double, 6, 1> point;
    point << state.floor_map, state.yaw_rad, -robot.slope_pitch * std::atan(state.slope),
        state.activity;
    points.push_back(point);
  }
  return points;
}

std::vector<MotionState> turned(std::vector<MotionState> states, double angle_rad) {
  const Eigen::Vector2d x = direction(angle_rad);
  for (MotionState& state : states) {
    state.floor_map.head<2>() = (state.floor_map.x() * x + state.floor_map.y() * leftOf(x)).eval();
    state.yaw_rad += angle_rad;
  }
  return states;
}

Eigen::Matrix3d rotation(double yaw_rad, double pitch_rad, double roll_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

Trajectory::Trajectory(const std::vector<MotionState>& states, const Robot& robot)
    : spline_(controlPoints(states, robot), kMotionPeriod_s), robot_(robot) {}

Pose Trajectory::T_map_base(double time_s) const {
  // Phases that keep the extremes of the six motions apart, as in an animal's walk.
  constexpr double kRollPhase_rad = 0.6;
  constexpr double kPitchPhase_rad = 1.1;
  constexpr double kYawPhase_rad = 2.0;
  const Eigen::Matrix<double, 6, 1> walk = spline_.at(time_s);
  const double activity = walk[5];
  const double stride = 2.0 * M_PI * robot_.gait.stride_hz * time_s;
  const Gait& gait = robot_.gait;

  Pose T = Pose::Identity();
  T.linear() =
      rotation(walk[3] + activity * gait.yaw_rad * std::sin(stride + kYawPhase_rad),
               walk[4] + activity * gait.pitch_rad * std::sin(2.0 * stride + kPitchPhase_rad),
               activity * gait.roll_rad * std::sin(stride + kRollPhase_rad));
  const Eigen::Vector2d sway =
      activity * gait.sway_m * std::sin(stride) * leftOf(direction(walk[3]));
  const double bob_m = activity * gait.bob_m * std::sin(2.0 * stride);
  T.translation() = walk.head<3>() + Eigen::Vector3d(sway.x(), sway.y(), bob_m);
  T.translation().z() += robot_.base_height_m;
  return T;
}

Eigen::Vector3d Trajectory::angularVelocity_base(double time_s) const {
  const Pose T_before = T_map_base(time_s - kStep_s);
  const Pose T_after = T_map_base(time_s + kStep_s);
  return logSO3(T_before.linear().transpose() * T_after.linear()) / (2.0 * kStep_s);
}

Eigen::Vector3d Trajectory::velocity_map(double time_s) const {
  return (T_map_base(time_s + kStep_s).translation() - T_map_base(time_s - kStep_s).translation()) /
         (2.0 * kStep_s);
}

Eigen::Vector3d Trajectory::acceleration_map(double time_s) const {
  return (T_map_base(time_s + kStep_s).translation() - 2.0 * T_map_base(time_s).translation() +
          T_map_base(time_s - kStep_s).translation()) /
         (kStep_s * kStep_s);
}

Trajectory walkTour(const Building& building, const Robot& robot, const MotionLimits& limits,
                    double turn_rad) {
  std::vector<FloorPlan> plans;
  for (size_t k = 0; k < building.storeys.size(); ++k) plans.emplace_back(building, k);
  const Route route = planTour(building, plans);
  for (const RoutePoint& point : route) {
    if (point.by_stairs && !robot.climbs_stairs) {
      throw std::invalid_argument("the tour of '" + building.name +
                                  "' takes the stairs, which the gait '" + robot.name +
                                  "' cannot climb");
    }
  }
  const double start_turn_rad = std::remainder(turn_rad, 2.0 * M_PI);
  return {turned(planMotion(route, plans, limits, start_turn_rad), turn_rad), robot};
}

}  // namespace mrpt_sgraphs::sim
