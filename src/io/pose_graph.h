// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A relative pose between two keyframes.
struct PoseEdge {
  KeyframeId from;
  KeyframeId to;
  Pose T_from_to = Pose::Identity();
  Matrix6 information = Matrix6::Zero();  ///< Of the right perturbation of T_from_to.
};

/// The keyframes layer alone, for what knows nothing but poses, as connected as the graph is:
///
/// - its relative poses as they are;
/// - of each condensed factor, for every other keyframe that it reaches, the marginal of its
///   quadratic on where the kept keyframe has that one, all its other nodes minimized over. Where
///   that leaves a direction open, the way through relative poses that the factor remembers;
/// - every dropped keyframe where it is now, on a stiff edge from the one that it moves with.
///
/// Each edge of a condensed factor is right by itself; that they were found together is lost.
std::vector<PoseEdge> poseGraph(const GraphSnapshot& graph);

}  // namespace mrpt_sgraphs
