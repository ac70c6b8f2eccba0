// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/wall_track.h"

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {

void redraw(double cell_m, const LayeredGraph& graph, WallTrack* track) {
  if (track->sightings.empty()) return;  // nothing is left to draw it from
  refit(graph, track);
  if (track->id) track->plane_map = graph.plane(*track->id);
  track->extent = WallExtent(track->plane_map, track->anchor_map, cell_m);
  for (const SurfaceSighting& sighting : track->sightings) {
    track->extent.add(graph.pose(sighting.keyframe) * observedBy(sighting, graph).extent_base);
  }
  track->box_map = track->extent.box_map();
  track->outline_map.reset();
  updateFloor(graph, track);
  track->grown = true;
}

void extend(const SurfaceSighting& sighting, const LayeredGraph& graph, WallTrack* track) {
  addSighting(sighting, graph, track);
  const double area_m2 = track->extent.area_m2();
  track->extent.add(graph.pose(sighting.keyframe) * observedBy(sighting, graph).extent_base);
  track->grown = true;
  if (track->extent.area_m2() == area_m2) return;  // nothing new of it
  track->box_map = track->extent.box_map();
  track->outline_map.reset();
}

bool isFree(const WallTrack& track, const LayeredGraph& graph) {
  if (!track.id) return true;
  for (const FactorLink& link : graph.otherFactorsOf(*track.id)) {
    const Factor* const factor = graph.factor(link.id).get();
    const bool is_renewed = dynamic_cast<const WallPairFactor*>(factor) != nullptr ||
                            dynamic_cast<const RoomWallFactor*>(factor) != nullptr ||
                            dynamic_cast<const RoomCentreFactor*>(factor) != nullptr ||
                            dynamic_cast<const CondensedFactor*>(factor) != nullptr;
    if (!is_renewed) return false;
  }
  return true;
}

}  // namespace mrpt_sgraphs
