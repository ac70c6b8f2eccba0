// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// For every keyframe the covariance of T_keyframe_newest, right perturbation of the newest, added up
/// along the most certain way through the graph. A bound from above: other ways can only add to what
/// is known.
/// @param keyframes  In id order with consecutive ids, the newest last.
std::vector<Matrix6> uncertaintyToNewest(const std::vector<KeyframeNode>& keyframes,
                                         const std::vector<RelativePoseEdge>& edges);

}  // namespace mrpt_sgraphs
