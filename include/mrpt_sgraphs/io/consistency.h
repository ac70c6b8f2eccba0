// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/divergence.h"
#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs {

/// The factors of the graph as if nothing had ever been compressed: all that are shelved, and the
/// others but those that stand for them, which are condensed factors and bridges. A stand-in can be
/// on the shelf itself, for another one: it is left out as well.
/// @throws std::runtime_error if what a factor stands for is not on the shelf.
std::vector<const Factor*> originalFactors(const GraphSnapshot& graph);

/// How big a graph is to a solver.
struct ModelSize {
  std::size_t keyframes = 0;
  std::size_t factors = 0;
  Eigen::Index tangents = 0;  ///< Of all free nodes.
};

/// What compression made of a graph.
struct CompressionReport {
  ModelSize full;
  ModelSize compressed;
  /// Nodes of both that nothing is said on any more once the graph is compressed: walls that only
  /// dropped keyframes saw, where observations are dropped as well. They are not compared.
  std::vector<NodeId> lost;
  Divergence divergence;
};

/// Compares the graph's factors with originalFactors, both linearized at the graph's values, on
/// what both have: active keyframes, walls, rooms and floors, the first active keyframe being
/// fixed. Takes the third power of that many tangents in time, and the square in memory.
/// @throws std::runtime_error as originalFactors does, and if no keyframe is active.
CompressionReport compareWithOriginal(const GraphSnapshot& graph);

/// A squared error over its covariance, of many keyframes: as large as its degrees of freedom on
/// average, if the covariances are right.
struct NormalizedErrors {
  int dof = 0;
  double mean = 0.0;  ///< NaN of no keyframe, as the others.
  double median = 0.0;
  double p95 = 0.0;
};

/// The normalized estimation error squared (NEES) of active keyframes.
struct PoseConsistency {
  std::size_t keyframes = 0;
  std::size_t without_truth = 0;
  NormalizedErrors pose;
  NormalizedErrors position;
};

/// e' Sigma^-1 e with e = log( true T_first_k ^-1 T_first_k ) of active keyframes k, relative to
/// the first of them, and Sigma the marginal covariance of T_map_k under the graph's factors, the
/// first keyframe being fixed. The truth may be in any frame.
/// @param truth  Poses of the same body, interpolated between two that are at most max_gap_s apart.
/// @throws std::runtime_error if no keyframe is active or the first one has no truth.
PoseConsistency posesAgainstTruth(const GraphSnapshot& graph, const Trajectory& truth,
                                  double max_gap_s);

}  // namespace mrpt_sgraphs
