// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/hierarchy/regions.h"

namespace mrpt_sgraphs {

/// What is compressed at a time where the whole graph is there at once: each stay in a region, in
/// the order in which they came, those of one region one after another and with the same kept
/// keyframe.
///
/// As planRegions, but no keyframe is too new, and nothing is given up: of every factor between
/// keyframes of two regions one end stays. What no room is around is cut by the way that the robot
/// took, not by place: before the first optimization places tell nothing.
///
/// @param longest  Keyframes in a row, in no room, that are one region.
std::vector<RegionPlan> planWholeGraph(const LayeredGraph& graph, std::size_t longest);

/// The same for mode `paper`: of each room all but the first keyframe go, and of what is in no room
/// none.
std::vector<RegionPlan> planWholeGraphByTheLetter(const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
