// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/geometry/point_cloud.h"

namespace mrpt_sgraphs {

/// How far a spinning sensor had turned at each point, 0 to about 1 from the first point to the last,
/// found from the order of the points: many drivers send no times, but in the order of firing.
///
/// @param cloud  In the sensor's frame, its axis of rotation along z.
/// @return One fraction of the sweep a point; empty where the azimuth does not run steadily once
///         round, as in clouds that are sorted by ring or by voxel.
std::vector<float> sweepFractions(const Cloud& cloud);

}  // namespace mrpt_sgraphs
