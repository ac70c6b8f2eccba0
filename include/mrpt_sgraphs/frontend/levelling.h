// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/voxel_map.h"

namespace mrpt_sgraphs {

/// Rotation R_level_base that makes the ground horizontal, found among the planes of a first scan
/// (base frame): the up-facing ones below the sensor that agree best, within 30 degrees of upright.
/// Identity where there is no ground to be seen.
Eigen::Matrix3d levelFromGround(const std::vector<MapPlane>& planes_base);

}  // namespace mrpt_sgraphs
