// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// An edge of a keyframe that is dropped, as one of a keyframe that stays: the composed measurement,
/// and the covariances added up.
/// @param edge              Between `gone` and another keyframe than `stays`.
/// @param covariance        Of T_stays_gone, right perturbation of `gone`.
RelativePoseFactor transferred(const RelativePoseFactor& edge, KeyframeId gone, KeyframeId stays,
                               const Matrix6& covariance, const LayeredGraph& graph);

/// Adds an edge, or makes it and the one between the same keyframes that was transferred before one:
/// their informations add up, and the measurement is where both together have their optimum.
void addTransferred(const RelativePoseFactor& edge, LayeredGraph* graph);

/// What layers have put at a keyframe and would put at any other as well, the thickness of walls and
/// where the room is: put at the one that stays, so that its residual is what it was.
void carryOver(KeyframeId gone, KeyframeId stays, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
