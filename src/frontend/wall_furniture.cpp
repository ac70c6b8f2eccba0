// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// What looks like a wall and is a shelf, a cabinet, a row of tables or a pillar.

#include <cmath>
#include <iterator>

#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {

void WallLayer::lookThrough(KeyframeId newest, const LayeredGraph& graph) {
  constexpr double kNear_m = 15.0;
  constexpr int kBeyond = 8;  // cells beside the extent that may tell something
  const KeyframeAttributes& keyframe = graph.attributes(newest);
  if (keyframe.cloud == nullptr) return;
  const Pose T_map_base = graph.pose(newest);
  for (auto& [number, track] : tracks_) {
    if (track.is_furniture || track.extent.empty()) continue;
    if (track.box_map.exteriorDistance(T_map_base.translation()) > kNear_m) continue;
    track.see_through.moveTo(track.plane_map);
    const CellSet seen = track.extent.cellsOn(track.see_through.frame(), SeeThrough::kCell_m);
    track.see_through.add(*keyframe.cloud, T_map_base, seen.box().grown(kBeyond));
    track.is_furniture = isFurniture(track.see_through.openEdgesOf(seen), hasWallBehind(track));
  }
}

bool WallLayer::hasWallBehind(const WallTrack& track) const {
  // as deep as a shelf, and not so near that it may be the same surface
  constexpr double kMinDepth_m = 0.15;
  constexpr double kMaxDepth_m = 0.8;
  constexpr double kBeside_m = 1.0;
  const Eigen::Vector3d centre_map = track.extent.centre_map();
  for (const auto& [number, wall] : tracks_) {
    if (!wall.id || wall.extent.area_m2() < track.extent.area_m2()) continue;
    if (wall.plane_map.normal.dot(track.plane_map.normal) < std::cos(config_.max_angle_rad)) {
      continue;
    }
    const double depth_m = wall.plane_map.normal.dot(centre_map) - wall.plane_map.distance;
    if (depth_m < kMinDepth_m || depth_m > kMaxDepth_m) continue;
    if (wall.box_map.exteriorDistance(track.box_map) < kMaxDepth_m + kBeside_m) return true;
  }
  return false;
}

bool WallLayer::giveUpFurniture(LayeredGraph* graph) {
  bool changed = false;
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    auto& [number, track] = *entry;
    if (!track.is_furniture || !track.id || !isFree(track, *graph)) {
      ++entry;
      continue;
    }
    erasePairsOf(number, graph);
    for (SurfaceSighting& sighting : track.sightings) sighting.factor.reset();
    graph->eraseNode(*track.id);
    track.id.reset();
    mrpt_sgraphs::dropErased(*graph, &track.sightings);  // what was let go of has no factor now
    entry = track.sightings.empty() ? tracks_.erase(entry) : std::next(entry);
    changed = true;
  }
  return changed;
}

}  // namespace mrpt_sgraphs
