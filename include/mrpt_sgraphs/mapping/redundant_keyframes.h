// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// Dropped keyframes whose clouds and planes the map can do without: an older keyframe that keeps
/// its cloud stands within `spacing_m`, on the same floor and in the same room. What is in no room
/// or on no floor counts as being in one of its own. So there are as many clouds as places, and not
/// as many as visits.
///
/// Keyframes that the optimization still knows are never among them. What a place looks like does
/// not depend on the heading: true of lidars that look all around.
/// @param spacing_m  Positive.
/// @return In the order of the keyframes.
/// @throws std::invalid_argument for a spacing that is not positive.
std::vector<KeyframeId> redundantKeyframes(const GraphSnapshot& graph, double spacing_m);

}  // namespace mrpt_sgraphs
