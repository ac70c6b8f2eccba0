// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <vector>

#include "mrpt_sgraphs/frontend/see_through.h"
#include "mrpt_sgraphs/frontend/surface_sighting.h"
#include "mrpt_sgraphs/frontend/wall_extent.h"

namespace mrpt_sgraphs {

/// The number of a track: in the order in which they began.
using TrackNumber = uint64_t;

/// One side of a wall, from its first sighting on: on probation, then a node of the graph.
struct WallTrack : SurfaceTrack {
  std::optional<WallId> id;  ///< None on probation.
  WallExtent extent;
  Eigen::AlignedBox3d box_map;  ///< Around the extent.
  double seen_at_m = 0.0;       ///< The way that the robot had gone at the last sighting.
  SeeThrough see_through;
  bool is_furniture = false;    ///< Was seen over, or past its ends: never a wall.
  bool grown = true;            ///< Since it was last compared with the others.
  std::optional<PlanarExtent> outline_map;  ///< Of the extent, on its grid; none after a change.
  std::set<TrackNumber> apart;              ///< What was split from it: not to be merged again.
};

/// Everything anew from all sightings, but for the plane of a wall of the graph.
void redraw(double cell_m, const LayeredGraph& graph, WallTrack* track);

/// One more sighting, and the extent with it.
void extend(const SurfaceSighting& sighting, const LayeredGraph& graph, WallTrack* track);

/// Nothing but sightings, pairs and rooms ties the track's wall to the rest: they are found again
/// when it has become another.
bool isFree(const WallTrack& track, const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
