// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// What an optimization changes, and what it sees and leaves alone. All factors that touch a free
/// node take part.
struct Selection {
  std::vector<NodeId> free;
  std::vector<NodeId> fixed;

  /// What to do with a factor that joins a free node to one that is in neither list: most often
  /// that node was forgotten, and information would be lost. Where it is meant, say so here.
  enum class Outside { kIsAnError, kIsLeftOut };
  Outside outside = Outside::kIsAnError;

  /// For free walls and floors: what all keyframes that are in neither list say on them, in place of
  /// those sightings one by one.
  std::vector<SummedObservationsFactor> sums;
};

/// The whole graph; the first keyframe stays, so that the map does.
Selection selectAll(const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
