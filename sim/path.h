// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/floor_plan.h"
#include "sim/motion.h"
#include "sim/tour.h"

namespace mrpt_sgraphs::sim {

/// A point of the way and how fast it may be passed.
struct PathSample {
  Eigen::Vector3d floor_map = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double max_speed_m_s = 0.0;
};

/// Between two stops: the heading is continuous, samples lie a few centimetres apart.
using Path = std::vector<PathSample>;

/// The route with its corners rounded. Where no arc fits, one path ends and the next begins at the
/// same place with another heading.
std::vector<Path> roundCorners(const Route& route, const std::vector<FloorPlan>& plans,
                               const MotionLimits& limits);

}  // namespace mrpt_sgraphs::sim
