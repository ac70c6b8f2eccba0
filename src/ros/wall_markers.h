// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// Walls where they are, each in its own colour, with their ids, and what keyframes see them.
void addWallMarkers(const GraphSnapshot& graph, const std::string& map_frame,
                    visualization_msgs::MarkerArray* markers);

/// A square on the ground around the centre of each floor.
void addFloorMarkers(const GraphSnapshot& graph, const std::string& map_frame,
                     visualization_msgs::MarkerArray* markers);

}  // namespace mrpt_sgraphs
