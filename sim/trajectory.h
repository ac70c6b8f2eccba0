// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mrpt_sgraphs/geometry/pose.h"
#include "sim/building.h"
#include "sim/motion.h"
#include "sim/robot.h"
#include "sim/spline.h"

namespace mrpt_sgraphs::sim {

/// The true motion of base_link in map: C2 in position and orientation, from rest to rest.
class Trajectory {
 public:
  Trajectory(const std::vector<MotionState>& states, const Robot& robot);

  Pose T_map_base(double time_s) const;

  /// In base_link: what an ideal gyroscope there reads [rad/s].
  Eigen::Vector3d angularVelocity_base(double time_s) const;
  Eigen::Vector3d velocity_map(double time_s) const;
  Eigen::Vector3d acceleration_map(double time_s) const;

  double duration_s() const { return spline_.duration_s(); }

 private:
  Spline<6> spline_;  ///< x, y, z of the floor [m]; yaw, pitch [rad]; activity.
  Robot robot_;
};

/// Walks the tour of the building.
/// @param turn_rad  The walk is turned by it about the origin, as the building will be. Ways are
///                  found before, so that they do not depend on it. The robot's first heading is
///                  not turned, and it begins by turning on the spot: were it turned with all the
///                  rest, its sensors would measure the same whatever the angle.
/// @throws std::invalid_argument if it cannot be walked, naming the place in the file.
Trajectory walkTour(const Building& building, const Robot& robot,
                    const MotionLimits& limits = MotionLimits{}, double turn_rad = 0.0);

}  // namespace mrpt_sgraphs::sim
