// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/wall_track.h"

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

KeptExtent& keptWith(KeyframeId with, double cell_m, const LayeredGraph& graph, WallTrack* track) {
  for (KeptExtent& kept : track->kept) {
    if (kept.with == with) return kept;
  }
  track->kept.push_back(
      {with, graph.pose(with), WallExtent(track->plane_map, track->anchor_map, cell_m)});
  return track->kept.back();
}

}  // namespace

void redraw(double cell_m, const LayeredGraph& graph, WallTrack* track) {
  if (track->sightings.empty()) return;  // nothing is left to draw it from
  refit(graph, track);
  if (track->id) track->plane_map = graph.plane(*track->id);
  track->extent = WallExtent(track->plane_map, track->anchor_map, cell_m);
  for (const SurfaceSighting& sighting : track->sightings) {
    if (sighting.observed == nullptr) continue;
    track->extent.add(graph.pose(sighting.keyframe) * sighting.observed->extent_base);
  }
  for (const KeptExtent& kept : track->kept) {
    const Pose T_map_then = graph.contains(kept.with)
                                ? graph.pose(kept.with) * kept.T_map_with.inverse()
                                : Pose::Identity();
    track->extent.add(kept.extent.moved(T_map_then));
  }
  track->box_map = track->extent.box_map();
  track->outline_map.reset();
  updateFloor(graph, track);
  track->grown = true;
}

void extend(const SurfaceSighting& sighting, const LayeredGraph& graph, WallTrack* track) {
  addSighting(sighting, graph, track);
  const double area_m2 = track->extent.area_m2();
  track->extent.add(graph.pose(sighting.keyframe) * sighting.observed->extent_base);
  track->grown = true;
  if (track->extent.area_m2() == area_m2) return;  // nothing new of it
  track->box_map = track->extent.box_map();
  track->outline_map.reset();
}

void letGo(const std::set<KeyframeId>& keyframes, double cell_m, const LayeredGraph& graph,
           WallTrack* track) {
  for (SurfaceSighting& sighting : track->sightings) {
    if (keyframes.count(sighting.keyframe) == 0 || sighting.observed == nullptr) continue;
    if (sighting.factor) {
      const auto& representative = graph.attributes(sighting.keyframe).representative;
      const KeyframeId with = representative.value_or(sighting.keyframe);
      KeptExtent& kept = keptWith(with, cell_m, graph, track);
      const Pose T_then_base =
          kept.T_map_with * graph.pose(with).inverse() * graph.pose(sighting.keyframe);
      kept.extent.add(T_then_base * sighting.observed->extent_base);
    }
    letGo(&sighting);
  }
  dropErased(graph, &track->sightings);
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
