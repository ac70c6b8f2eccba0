// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

/// T_floor_map: z is up and zero on the ground; above the foot of the map's origin.
inline Pose floorFrame(const Plane& ground_map) {
  const PlaneFrame frame(ground_map, Eigen::Vector3d::Zero());
  Pose T_floor_map = Pose::Identity();
  T_floor_map.linear() = frame.rotation();
  T_floor_map.translation() = -(frame.rotation() * frame.origin);
  return T_floor_map;
}

}  // namespace mrpt_sgraphs
