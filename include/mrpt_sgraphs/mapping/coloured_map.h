// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/mapping/wall_points.h"

namespace mrpt_sgraphs {

/// The points of all keyframes in `map`, in the colours of the rooms that they bound or lie in;
/// grey where no room is.
/// @param resolution_m  One point a voxel; every point for zero or less.
ColouredCloud::Ptr mapByRooms(const GraphSnapshot& graph, double resolution_m);

/// The graph with the clouds of the keyframes that were on a floor alone.
/// @param name  Of the floor, or its id in digits.
/// @throws std::invalid_argument saying which floors there are, if it is none.
GraphSnapshot onFloor(const GraphSnapshot& graph, const std::string& name);

}  // namespace mrpt_sgraphs
