// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The graph to look at, all that was shown before replaced: keyframes as black spheres, odometry
/// edges grey, loop closures red; walls in colours of their own, with their doors, outlines and
/// ids, and thin grey lines from the keyframes that see them; a green square on each floor. A
/// namespace for each, so that rviz can switch it.
visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph, const std::string& map_frame);

}  // namespace mrpt_sgraphs
