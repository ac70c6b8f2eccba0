// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// How the graph is shown.
struct GraphView {
  std::string map_frame;
  double layer_lift_m = 0.0;  ///< Each layer so far above the one below; 0: all of it in place.
};

/// The graph to look at, all that was shown before replaced. The keyframes are where they are;
/// walls, rooms and floors hover above, each layer a lift higher, and what joins two layers is
/// drawn from where the one end is shown to where the other is. What there is to see has a
/// namespace each, so that rviz can switch it:
///
///   keyframes, marginalized_keyframes      black and red spheres
///   odometry, loop_closures                grey and red lines
///   condensed, condensed_observations      violet lines from the kept keyframe of a condensed factor
///                                          to the keyframes and walls that it is tied to
///   free_keyframes, fixed_keyframes        green and blue boxes: the last optimization
///   walls, wall_outlines, wall_ids         in colours of their own, with their doors
///   wall_observations                      from the keyframes to the walls that they see
///   rooms, room_names, room_areas, room_outlines     nodes, and the ground of each
///   room_walls                             to the walls that bound a room
///   doorways, room_doorways                to the doorways, and so from room to room
///   floors, floor_names, floor_rooms       nodes, and to the rooms on each
///   floor_connections                      by way of the stairs from floor to floor
///
/// @param last_optimization  Null: no keyframe is boxed.
visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph, const GraphView& view,
                                          const OptimizationSummary* last_optimization);

}  // namespace mrpt_sgraphs
