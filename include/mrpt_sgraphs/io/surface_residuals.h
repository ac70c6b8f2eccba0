// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// How the observations of planes agree with where the graph has them: chi2 = e' Omega e of each,
/// before its robust kernel. Honest covariances give a mean of nearly 3 (a little less, as the
/// estimates follow the measurements), and one in twenty above the 95 % quantile.
struct ResidualStatistics {
  std::size_t count = 0;
  double mean_chi2 = 0.0;  ///< NaN if there is none.
  double above_95 = 0.0;   ///< Share above 7.815; NaN if there is none.
};

struct SurfaceResiduals {
  ResidualStatistics wall_observation;
  ResidualStatistics ground_observation;
};

SurfaceResiduals surfaceResiduals(const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
