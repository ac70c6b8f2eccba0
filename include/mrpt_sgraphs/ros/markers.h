// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The graph to look at: keyframes as black spheres, odometry edges grey, loop closures red. One
/// namespace a layer, so that rviz can switch each of them.
visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph, const std::string& map_frame);

}  // namespace mrpt_sgraphs
