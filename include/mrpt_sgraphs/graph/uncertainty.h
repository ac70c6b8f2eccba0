// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// For every keyframe the covariance of T_keyframe_newest, right perturbation of the newest, added
/// up along the most certain way through the graph. A bound from above: other ways can only add to
/// what is known.
/// @param graph  With one keyframe or more; the newest is the last.
/// @return In the order of the keyframes.
std::vector<Matrix6> uncertaintyToNewest(const GraphSnapshot& graph);

}  // namespace mrpt_sgraphs
