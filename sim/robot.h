// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs::sim {

/// How the body moves about the walk, at full speed; in proportion to the activity below it.
/// Sway, roll and yaw go with the stride, bob and pitch at twice its frequency.
struct Gait {
  double stride_hz = 0.0;
  double bob_m = 0.0;
  double sway_m = 0.0;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

struct Robot {
  std::string name;
  double base_height_m = 0.0;   ///< Of base_link above the floor.
  double lidar_height_m = 0.0;  ///< Of the lidar above base_link.
  double slope_pitch = 0.0;     ///< The part of a slope that the body leans with.
  bool climbs_stairs = false;
  Gait gait;

  /// @param pitch_rad  Of the lidar's mount, positive with the nose down.
  Pose T_base_lidar(double pitch_rad) const;
};

/// `legged` or `wheeled`.
/// @throws std::invalid_argument naming the known ones.
Robot robotNamed(const std::string& name);

}  // namespace mrpt_sgraphs::sim
