// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/floor_plan.h"
#include "sim/tour.h"

namespace mrpt_sgraphs::sim {

/// How the robot walks a route, before its gait.
struct MotionLimits {
  double walking_m_s = 0.95;   ///< An unhurried walk; gait adds a little.
  double stairs_m_s = 0.45;    ///< Horizontally.
  double turning_rad_s = 0.9;  ///< In curves and on the spot.
  double acceleration_m_s2 = 0.6;
  double still_s = 1.5;  ///< At the start and the end: initialization needs it.
};

/// Where the robot is at one moment, on the floor.
struct MotionState {
  Eigen::Vector3d floor_map = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;   ///< Goes on counting beyond pi.
  double slope = 0.0;     ///< Rise over run of the floor in the direction of walking.
  double activity = 0.0;  ///< 0 at rest, 1 at full speed or full turning rate.
};

/// Between the states of a motion; the spline over them rounds what changes faster than this.
constexpr double kMotionPeriod_s = 0.15;

/// Walks the route: corners rounded as far as walls and furniture allow, else turned on the spot;
/// speed limited by curvature and acceleration.
/// @param start_turn_rad  By how much the robot turns to the left on the spot before it walks.
/// @return One state every kMotionPeriod_s, from rest to rest.
std::vector<MotionState> planMotion(const Route& route, const std::vector<FloorPlan>& plans,
                                    const MotionLimits& limits, double start_turn_rad = 0.0);

}  // namespace mrpt_sgraphs::sim
