// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// Which storey a wall is of.

#include <algorithm>
#include <cmath>
#include <map>

#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {
namespace {

/// Of the map, where the vertical through a point meets a ground.
double heightUnder(const Eigen::Vector3d& point_map, const Plane& ground_map) {
  const Eigen::Vector2d& level = ground_map.normal.head<2>();
  return (ground_map.distance - level.dot(point_map.head<2>())) / ground_map.normal.z();
}

bool areFar(double a_m, double b_m, double limit_m) {
  return a_m != b_m && !(std::abs(a_m - b_m) <= limit_m);
}

}  // namespace

void updateFloor(const LayeredGraph& graph, WallTrack* track) {
  std::map<FloorId, int> counts;
  for (const SurfaceSighting& sighting : track->sightings) {
    if (const std::optional<FloorId>& floor = floorOf(sighting, graph)) ++counts[*floor];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  std::optional<FloorId> floor;
  if (most != counts.end()) floor = most->first;
  if (track->floor != floor) track->grown = true;  // what was apart from it may be one with it now
  track->floor = floor;
  track->is_on_more = counts.size() > 1;
}

bool WallLayer::goOnInEachOther(const WallTrack& a, const WallTrack& b,
                                const LayeredGraph& graph) const {
  if (!a.id || !b.id || !areApart(a.floor, b.floor)) return false;
  if (!graph.contains(*a.floor) || !graph.contains(*b.floor)) return false;
  return a.box_map.intersects(b.box_map) &&
         isSameSurface(a.plane_map, a.extent.centre_map(), b.plane_map) &&
         a.extent.overlaps(b.extent);
}

void WallLayer::cutAtGrounds(const LayeredGraph& graph) {
  if (graph.size(Layer::kFloor) < 2) return;
  std::map<TrackNumber, StoreyCut> cuts;
  for (auto a = tracks_.begin(); a != tracks_.end(); ++a) {
    for (auto b = std::next(a); b != tracks_.end(); ++b) {
      if (!goOnInEachOther(a->second, b->second, graph)) continue;
      const Eigen::Vector3d centre_map = a->second.extent.centre_map();
      const double heights_m[] = {heightUnder(centre_map, graph.plane(*a->second.floor)),
                                  heightUnder(centre_map, graph.plane(*b->second.floor))};
      const double cut_m = std::max(heights_m[0], heights_m[1]);
      StoreyCut& lower = cuts[heights_m[0] < heights_m[1] ? a->first : b->first];
      StoreyCut& upper = cuts[heights_m[0] < heights_m[1] ? b->first : a->first];
      lower.top_m = std::min(lower.top_m, cut_m);
      upper.bottom_m = std::max(upper.bottom_m, cut_m);
    }
  }
  for (auto& [number, track] : tracks_) {
    const StoreyCut& cut = cuts[number];
    const double limit_m = 0.5 * config_.cell_m;
    if (!areFar(cut.top_m, track.cut.top_m, limit_m) &&
        !areFar(cut.bottom_m, track.cut.bottom_m, limit_m)) {
      continue;
    }
    track.cut = cut;
    track.outline_map.reset();
  }
}

}  // namespace mrpt_sgraphs
