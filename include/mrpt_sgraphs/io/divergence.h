// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "mrpt_sgraphs/io/linear_model.h"

namespace mrpt_sgraphs {

/// A marginal standard deviation over the one that it should be.
struct DeviationRatio {
  NodeId node;
  double ratio = 1.0;  ///< Below 1: over-confident.
};

/// How far the Gaussian of a compressed graph is from that of the full one, on the same nodes. With
/// the informations A of the full one and B of the compressed one, and d between their means,
///
///     KL(compressed || full) = 1/2 ( tr(A B^-1) - n + d' A d + ln det B - ln det A )   [nats]
struct Divergence {
  Eigen::Index dof = 0;           ///< n
  double compressed_to_full = 0;  ///< KL(compressed || full)
  double full_to_compressed = 0;  ///< KL(full || compressed)
  double mean_to_full = 0;        ///< d' A d, the part of the means: chi2 of n degrees of freedom.
  double prior_share = 0;         ///< The prior that made both of them Gaussians, see kPriorShare.
  int undetermined_full = 0;      ///< Directions that only this prior determines in the full one,
  int undetermined_compressed = 0;  ///< ... and in the other. More: they were lost, and each adds a
                                    ///< huge number that says no more than this.
  /// Over the positions of keyframes, of each in the direction where it is worst, and the distances
  /// of walls. None: there are neither.
  std::optional<DeviationRatio> smallest;
  std::optional<DeviationRatio> largest;
};

/// @throws std::invalid_argument if the two are not on the same nodes in the same order,
///         std::runtime_error if one is no information.
Divergence divergence(const MarginalModel& full, const MarginalModel& compressed);

}  // namespace mrpt_sgraphs
