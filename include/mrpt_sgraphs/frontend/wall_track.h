// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "mrpt_sgraphs/frontend/see_through.h"
#include "mrpt_sgraphs/frontend/surface_sighting.h"
#include "mrpt_sgraphs/frontend/wall_extent.h"

namespace mrpt_sgraphs {

/// The number of a track: in the order in which they began.
using TrackNumber = uint64_t;

/// Where the wall of one storey ends and that of another goes on [m].
struct StoreyCut {
  double bottom_m = -std::numeric_limits<double>::infinity();
  double top_m = std::numeric_limits<double>::infinity();

  template <typename Archive>
  void archive(Archive& a) {
    a("bottom_m", bottom_m);
    a("top_m", top_m);
  }
};

/// How far keyframes saw a wall whose planes were let go of: nobody can draw it again.
struct KeptExtent {
  KeyframeId with;                          ///< That it moves with,
  Pose T_map_with = Pose::Identity();       ///< and where that was when it was drawn.
  WallExtent extent;

  template <typename Archive>
  void archive(Archive& a) {
    a("with", with);
    a("T_map_with", T_map_with);
    a("extent", extent);
  }
};

/// One side of a wall, from its first sighting on: on probation, then a node of the graph.
struct WallTrack : SurfaceTrack {
  std::optional<WallId> id;  ///< None on probation.
  WallExtent extent;
  std::vector<KeptExtent> kept;  ///< One for each that they move with; is in the extent, too.
  Eigen::AlignedBox3d box_map;  ///< Around the extent.
  double seen_at_m = 0.0;       ///< The way that the robot had gone at the last sighting.
  SeeThrough see_through;
  bool is_furniture = false;     ///< Was seen over, or past its ends: never a wall.
  std::optional<FloorId> floor;  ///< Most keyframes that see it are on; none: no level is known.
  bool is_on_more = false;       ///< Keyframes of other levels see it too.
  StoreyCut cut;                 ///< Of the outline, not of the extent.
  bool grown = true;             ///< Since it was last compared with the others.
  std::optional<PlanarExtent> outline_map;  ///< Of the extent, on its grid; none after a change.
  std::set<TrackNumber> apart;              ///< What was split from it: not to be merged again.

  template <typename Archive>
  void archive(Archive& a) {
    SurfaceTrack::archive(a);
    a("id", id);
    a("extent", extent);
    a("kept", kept);
    a("box_map", box_map);
    a("seen_at_m", seen_at_m);
    a("see_through", see_through);
    a("is_furniture", is_furniture);
    a("floor", floor);
    a("is_on_more", is_on_more);
    a("cut", cut);
    a("grown", grown);
    a("outline_map", outline_map);
    a("apart", apart);
  }
};

/// Of a keyframe that sees, or may see, something; none: on stairs, or not known yet.
inline const std::optional<FloorId>& floorOf(const SurfaceSighting& sighting,
                                             const LayeredGraph& graph) {
  return graph.attributes(sighting.keyframe).floor;
}

/// Both are known, and not the same.
inline bool areApart(const std::optional<FloorId>& a, const std::optional<FloorId>& b) {
  return a && b && *a != *b;
}

/// The track's level from where its keyframes are now; of as many the older one.
void updateFloor(const LayeredGraph& graph, WallTrack* track);

/// Everything anew from all sightings, but for the plane of a wall of the graph.
void redraw(double cell_m, const LayeredGraph& graph, WallTrack* track);

/// One more sighting, and the extent with it.
void extend(const SurfaceSighting& sighting, const LayeredGraph& graph, WallTrack* track);

/// Lets go of what dropped keyframes have seen, but for how far they saw the wall: that moves with
/// those that stand for them. Sightings of which nothing is left are forgotten.
void letGo(const std::set<KeyframeId>& keyframes, double cell_m, const LayeredGraph& graph,
           WallTrack* track);

/// Nothing but sightings, condensed or not, pairs and rooms ties the track's wall to the rest: they
/// are found again when it has become another.
bool isFree(const WallTrack& track, const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
