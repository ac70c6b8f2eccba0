// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <set>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/hierarchy/hierarchy_config.h"

namespace mrpt_sgraphs {

/// What one kept keyframe is to stand for from now on.
struct RegionPlan {
  KeyframeId kept;
  std::optional<RoomId> room;          ///< None: what lies around the kept keyframe, in no room.
  std::vector<KeyframeId> dropped;     ///< In the order in which they came.
  std::vector<KeyframeId> stay;        ///< The kept one and the portals of the region.
  std::set<FactorId> transferred;      ///< Edges into other regions that another way is kept for.
};

/// Which keyframes can be dropped now, and for which kept one.
///
/// A region is a room, or what lies around a kept keyframe where there is no room. The first keyframe
/// of a region is kept. Of each way into another region one keyframe is kept, the portal: a node of
/// both regions' condensed factors, so that nothing of what is known about the way is lost. An edge
/// by a way that has its portal is transferred instead.
///
/// @param active      All keyframes that are not dropped, in the order in which they came.
/// @param first_late  Those from this place on are too new to be dropped.
std::vector<RegionPlan> planRegions(const LayeredGraph& graph,
                                    const std::vector<KeyframeId>& active, uint32_t first_late,
                                    const HierarchyConfig& config);

}  // namespace mrpt_sgraphs
