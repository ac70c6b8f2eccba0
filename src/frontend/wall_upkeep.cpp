// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// What the walls layer does after an optimization: extents that moved, walls that are one.

#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {
namespace {

bool hasMoved(const Pose& from, const Pose& to, double cell_m) {
  constexpr double kReach_m = 5.0;  // a turn is felt there
  const Tangent motion = local(from, to);
  return motion.head<3>().norm() + kReach_m * motion.tail<3>().norm() > cell_m;
}

}  // namespace

bool WallLayer::maintainAfterLoop(const WayToNewest& way, LayeredGraph* graph) {
  for (auto& [number, track] : tracks_) {
    track.grown = true;
    track.apart.clear();
  }
  return maintain({way, config_.loop_widening}, graph);
}

bool WallLayer::maintain(const Gate& gate, LayeredGraph* graph) {
  dropErased(graph);
  refreshPlanes(*graph);
  redrawMoved(graph);
  bool changed = splitTracks(graph);
  if (mergeTracks(gate, graph)) changed = true;
  if (promote(graph)) changed = true;
  if (updatePairs(graph)) changed = true;
  cutAtGrounds(*graph);
  updateOutlines(graph);
  for (auto& [number, track] : tracks_) track.grown = false;
  losses_ = graph->losses();
  return changed;
}

void WallLayer::redrawMoved(LayeredGraph* graph) {
  std::set<KeyframeId> moved;
  for (auto drawn = drawn_at_.begin(); drawn != drawn_at_.end();) {
    if (!graph->contains(drawn->first)) {
      drawn = drawn_at_.erase(drawn);
      continue;
    }
    const Pose T_map_base = graph->pose(drawn->first);
    if (hasMoved(drawn->second, T_map_base, config_.cell_m)) {
      moved.insert(drawn->first);
      drawn->second = T_map_base;
    }
    ++drawn;
  }
  if (moved.empty()) return;
  for (auto& [number, track] : tracks_) {
    const bool is_moved = std::any_of(
        track.sightings.begin(), track.sightings.end(),
        [&moved](const SurfaceSighting& sighting) { return moved.count(sighting.keyframe) != 0; });
    if (!is_moved) continue;
    redraw(config_.cell_m, *graph, &track);
    erasePairsOf(number, graph);  // their thickness was taken from where the faces were
  }
}

bool WallLayer::mergeTracks(const Gate& gate, LayeredGraph* graph) {
  std::vector<TrackNumber> open;
  for (const auto& [number, track] : tracks_) {
    if (track.grown) open.push_back(number);
  }
  bool changed = false;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (tracks_.count(open[k]) == 0) continue;  // it has become another
    const std::optional<TrackNumber> partner = partnerOf(open[k], gate, *graph);
    if (!partner || !partnerOf(*partner, gate, *graph)) continue;  // either may be in doubt
    changed = changed || tracks_.at(open[k]).id || tracks_.at(*partner).id;
    open.push_back(merge(open[k], *partner, graph));
  }
  return changed;
}

std::optional<TrackNumber> WallLayer::partnerOf(TrackNumber number, const Gate& gate,
                                                const LayeredGraph& graph) const {
  const WallTrack& track = tracks_.at(number);
  std::vector<Match> matches;
  for (const auto& [other, candidate] : tracks_) {
    if (areApart(track.floor, candidate.floor)) continue;
    if (other == number || track.apart.count(other) + candidate.apart.count(number) != 0) continue;
    const std::optional<SurfaceFit> fit = mergeFit(track, candidate, gate, graph);
    if (fit) matches.push_back({*fit, 0, other});
  }
  const auto best = std::min_element(matches.begin(), matches.end());
  if (best == matches.end() || !isBelieved(*best, matches)) return std::nullopt;
  return best->track;
}

std::optional<SurfaceFit> WallLayer::mergeFit(const WallTrack& a, const WallTrack& b,
                                              const Gate& gate, const LayeredGraph& graph) const {
  if (a.plane_map.normal.dot(b.plane_map.normal) < std::cos(config_.max_angle_rad)) {
    return std::nullopt;
  }
  if (a.box_map.exteriorDistance(b.box_map) > config_.max_gap_m + kRivals * config_.max_offset_m) {
    return std::nullopt;
  }
  const Eigen::Vector3d centres_map[] = {a.extent.centre_map(), b.extent.centre_map()};
  const double offset_m = b.plane_map.normal.dot(centres_map[0]) - b.plane_map.distance;
  const double back_m = a.plane_map.normal.dot(centres_map[1]) - a.plane_map.distance;
  if (std::max(std::abs(offset_m), std::abs(back_m)) > kRivals * config_.max_offset_m) {
    return std::nullopt;
  }
  if (!isFree(a, graph) && !isFree(b, graph)) return std::nullopt;

  const bool is_same = isSameSurface(a.plane_map, centres_map[0], b.plane_map) &&
                       isSameSurface(b.plane_map, centres_map[1], a.plane_map) &&
                       overlap(a.extent, b.extent);
  // Two that one keyframe saw are as far apart as it saw them; else each is known as well as the
  // way from the newest keyframe to where it was seen.
  bool share_a_keyframe = false;
  auto shared = b.sightings.begin();
  for (const SurfaceSighting& sighting : a.sightings) {
    while (shared != b.sightings.end() && shared->keyframe < sighting.keyframe) ++shared;
    if (shared == b.sightings.end()) break;
    if (shared->keyframe != sighting.keyframe) continue;
    share_a_keyframe = true;
    if (!is_same && !isCoplanarWithAll(b.sightings, sighting.keyframe, measuredBy(sighting, graph),
                                       graph)) {
      return std::nullopt;
    }
  }
  Matrix6 way = Matrix6::Zero();
  if (!share_a_keyframe) {
    way =
        gate.way.uncertaintyFrom(a.sightings, graph) + gate.way.uncertaintyFrom(b.sightings, graph);
  }
  const Pose T_map_base = graph.pose(gate.way.newest());
  SurfaceFit fit = fitOf(seenFrom(T_map_base, a, config_.floor, centres_map[0]), T_map_base, b,
                         config_.floor, way);
  if (!is_same && fit.chi2 > gate.widening * config_.max_chi2) return std::nullopt;
  const std::optional<double> gap_m = a.extent.gap_m(b.extent);
  if (!gap_m || *gap_m > config_.max_gap_m) return std::nullopt;
  if (std::abs(back_m) > std::abs(fit.offset_m)) fit.offset_m = -back_m;
  return fit;
}

TrackNumber WallLayer::merge(TrackNumber a, TrackNumber b, LayeredGraph* graph) {
  // A wall of the graph stays before a track on probation, and the older wall before the younger,
  // unless that one cannot go.
  const auto goesBefore = [&](TrackNumber x, TrackNumber y) {
    const WallTrack& first = tracks_.at(x);
    const WallTrack& second = tracks_.at(y);
    if (isFree(first, *graph) != isFree(second, *graph)) return !isFree(first, *graph);
    if (first.id.has_value() != second.id.has_value()) return first.id.has_value();
    return first.id ? *first.id < *second.id : x < y;
  };
  if (goesBefore(b, a)) std::swap(a, b);
  WallTrack& stays = tracks_.at(a);
  WallTrack& goes = tracks_.at(b);
  erasePairsOf(b, graph);
  if (goes.id) {  // a wall of the graph goes only for another
    replaceSurface(*goes.id, *stays.id, config_.kernel_chi2, &goes.sightings, graph);
  } else if (stays.id) {
    for (SurfaceSighting& sighting : goes.sightings) {
      addObservation(*stays.id, config_.kernel_chi2, &sighting, graph);
    }
  }
  stays.sightings = mergedByKeyframe(stays.sightings, goes.sightings);
  stays.seen_at_m = std::max(stays.seen_at_m, goes.seen_at_m);
  stays.kept.insert(stays.kept.end(), goes.kept.begin(), goes.kept.end());
  stays.see_through.add(goes.see_through);
  stays.is_furniture = stays.is_furniture && goes.is_furniture;
  stays.apart.insert(goes.apart.begin(), goes.apart.end());
  if (stays.id) {
    graph->setPlane(*stays.id,
                    fitted(summed(stays.sightings, stays.plane_map, stays.anchor_map, *graph),
                           stays.plane_map));
  }
  redraw(config_.cell_m, *graph, &stays);
  tracks_.erase(b);
  return a;
}

void WallLayer::updateOutlines(LayeredGraph* graph) {
  for (auto& [number, track] : tracks_) {
    if (!track.id) continue;
    if (!track.outline_map) {
      const WallExtent own = track.extent.between(track.cut.bottom_m, track.cut.top_m);
      track.outline_map = (own.empty() ? track.extent : own).outline_map(config_.max_gap_m);
    }
    WallAttributes attributes = graph->attributes(*track.id);
    if (track.floor) attributes.floor = track.floor;  // else, what its place tells
    attributes.extent_map = dropped(*track.outline_map, graph->plane(*track.id));
    graph->setAttributes(*track.id, attributes);
  }
}

}  // namespace mrpt_sgraphs
