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

/// All that takes part; the first keyframe stays, so that the map does. What no factor holds, dropped
/// keyframes too, takes no part, in no selection.
Selection selectAll(const LayeredGraph& graph);

/// The room-local stage (Sec. III-A): free are the keyframes within the room, the walls that they see
/// and its own, the room and its floor; what else these are tied to stays. If nothing does, the first
/// keyframe of the room stays.
///
/// Which keyframes are within is known by their attributes; of one that is in no room yet, Eq. (1)
/// tells, see isWithin.
/// @throws std::out_of_range for a room that is not in the graph.
Selection selectRoom(const LayeredGraph& graph, RoomId room);

/// One storey, for a loop that was closed on it: its keyframes, their walls, its rooms and the floor
/// are free; what else these are tied to, on stairs and other storeys, stays.
/// @throws std::out_of_range for a floor that is not in the graph.
Selection selectFloor(const LayeredGraph& graph, FloorId floor);

/// Eq. (1): whether a point is on the room's side of all its walls. The normals are turned against
/// the room's centre first: which way they point in the map tells nothing. Rooms that are not
/// enclosed by their walls alone, corridors and polygons, are told by their outline.
bool isWithin(const LayeredGraph& graph, RoomId room, const Eigen::Vector3d& point_map);

}  // namespace mrpt_sgraphs
