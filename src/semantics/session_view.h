// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "storey_plan.h"

namespace mrpt_sgraphs {

/// What a robot has seen lately of the storey that it is on.
struct SessionView {
  const KeyframeNode* newest = nullptr;
  /// z is up and zero on the ground, the origin below the newest keyframe.
  Pose T_session_view = Pose::Identity();
  StoreyPlan plan;
  double way_m = 0.0;  ///< Moved in all.

  double seen_m() const { return plan.cell_m() * static_cast<double>(plan.surfaces().size()); }
};

/// The ground under the newest keyframe: of its level in the graph, else the largest flat thing below
/// the last keyframes that is nearly level.
std::optional<Plane> groundOf(const GraphSnapshot& session);

/// @param keyframes  The newest that count.
/// @return Nothing where the newest keyframe has no cloud or no ground is known.
std::optional<SessionView> viewOf(const GraphSnapshot& session, std::size_t keyframes,
                                  const FreeSpaceConfig& config);

}  // namespace mrpt_sgraphs
