// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/wall_layer.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace mrpt_sgraphs {

/// What of two matches that exclude each other is the right one is told by no less: 90 to 1.
constexpr double kDoubt = 9.0;

bool WallLayer::isBelieved(const Match& match, const std::vector<Match>& all) const {
  // A track that is known far less well may well be the same surface, and excludes nothing.
  constexpr double kFarLess = 2.0;
  constexpr double kWellKnown_m = 0.02;
  const double comparable_m = std::max(kFarLess * match.fit.way_sigma_m, kWellKnown_m);
  if (std::abs(match.fit.offset_m) > config_.max_offset_m) return false;
  for (const Match& other : all) {
    if (other.plane != match.plane && other.track != match.track) continue;
    if (other.fit.way_sigma_m > comparable_m) continue;
    const bool excluded = std::abs(other.fit.offset_m - match.fit.offset_m) > kSameSurface_m;
    if (excluded && other.fit.surprise < match.fit.surprise + kDoubt) return false;
  }
  return true;
}

bool WallLayer::isSameSurface(const Plane& a, const Eigen::Vector3d& point_of_a, const Plane& b) {
  return a.normal.dot(b.normal) > std::cos(kSameSurface_rad) &&
         std::abs(b.normal.dot(point_of_a) - b.distance) < kSameSurface_m;
}

bool WallLayer::overlap(const WallExtent& a, const WallExtent& b) {
  constexpr double kShare = 0.2;  // of the smaller
  return a.sharedArea_m2(b) > kShare * std::min(a.area_m2(), b.area_m2());
}

bool WallLayer::isWallLike(const ObservedPlane& plane, const Pose& T_map_base) const {
  if (plane.area_m2 < config_.min_area_m2 || !canBeSighted(plane)) return false;
  const double up = (T_map_base.linear() * plane.plane_base.normal).z();
  return std::abs(up) <= std::sin(config_.max_tilt_rad);
}

std::optional<SurfaceFit> WallLayer::fitTo(const WallTrack& track, const ObservedPlane& seen,
                                           const WayToNewest& way,
                                           const LayeredGraph& graph) const {
  const Pose T_map_base = graph.pose(way.newest());
  // what is far or turned away is told by a few products
  const Eigen::Vector3d centroid_map = T_map_base * seen.centroid_base;
  const Eigen::Vector3d normal_map = T_map_base.linear() * seen.plane_base.normal;
  const double offset_m = track.plane_map.normal.dot(centroid_map) - track.plane_map.distance;
  if (std::abs(offset_m) > kRivals * config_.max_offset_m) return std::nullopt;
  if (normal_map.dot(track.plane_map.normal) < std::cos(config_.max_angle_rad)) return std::nullopt;
  const PlanarExtent extent_map = T_map_base * seen.extent_base;
  Eigen::AlignedBox3d box_map;
  for (const Eigen::Vector3d& corner : extent_map.outline) box_map.extend(corner);
  if (box_map.exteriorDistance(track.box_map) >
      config_.max_gap_m + kRivals * config_.max_offset_m) {
    return std::nullopt;
  }

  const SurfaceFit fit =
      fitOf(seen, T_map_base, track, config_.floor, way.uncertaintyFrom(track.sightings, graph));
  const bool agrees = fit.chi2 <= config_.max_chi2;
  if (!agrees && !isSameSurface(T_map_base * seen.plane_base, centroid_map, track.plane_map)) {
    return std::nullopt;
  }
  const WallExtent drawn = track.extent.drawn(extent_map);
  if (!agrees && !overlap(track.extent, drawn)) return std::nullopt;
  const std::optional<double> gap_m = track.extent.gap_m(drawn);
  if (!gap_m || *gap_m > config_.max_gap_m) return std::nullopt;
  return fit;
}

std::vector<WallLayer::Match> WallLayer::matchesOf(const WayToNewest& way,
                                                   const LayeredGraph& graph) const {
  const ObservedPlanes& planes = *graph.attributes(way.newest()).planes;
  const Pose T_map_base = graph.pose(way.newest());
  std::vector<Match> matches;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (!isWallLike(planes[k], T_map_base)) continue;
    for (const auto& [number, track] : tracks_) {
      if (areApart(graph.attributes(way.newest()).floor, track.floor)) continue;
      const std::optional<SurfaceFit> fit = fitTo(track, planes[k], way, graph);
      if (fit) matches.push_back({*fit, k, number});
    }
  }
  std::stable_sort(matches.begin(), matches.end());
  return matches;
}

bool WallLayer::isCoplanarWithAll(const std::vector<SurfaceSighting>& sightings,
                                  KeyframeId keyframe, const MeasuredPlane& plane,
                                  const LayeredGraph& graph) const {
  // those of one keyframe lie together, in the order of the keyframes
  const auto before = [](const SurfaceSighting& sighting, KeyframeId id) {
    return sighting.keyframe < id;
  };
  auto sighting = std::lower_bound(sightings.begin(), sightings.end(), keyframe, before);
  for (; sighting != sightings.end() && sighting->keyframe == keyframe; ++sighting) {
    const MeasuredPlane other = measuredBy(*sighting, graph);
    const double chi2 =
        chi2Between(plane.plane_base, plane.covariance, other.plane_base, other.covariance);
    if (chi2 > config_.max_chi2 &&
        !isSameSurface(plane.plane_base, plane.centroid_base, other.plane_base)) {
      return false;
    }
  }
  return true;
}

bool WallLayer::associate(const WayToNewest& way, LayeredGraph* graph) {
  const KeyframeId newest = way.newest();
  const ObservedPlanesConstPtr planes = graph->attributes(newest).planes;
  if (planes == nullptr) return false;
  dropErased(graph);
  refreshPlanes(*graph);
  const Pose T_map_base = graph->pose(newest);
  drawn_at_[newest] = T_map_base;

  bool changed = false;
  std::vector<bool> taken(planes->size(), false);
  const std::vector<Match> matches = matchesOf(way, *graph);
  for (const Match& match : matches) {
    WallTrack& track = tracks_.at(match.track);
    if (taken[match.plane] || !isBelieved(match, matches)) continue;
    SurfaceSighting sighting = sightingOf(newest, planes, match.plane, match.fit.way_sigma_m);
    const MeasuredPlane plane = measuredBy(sighting, *graph);
    if (!isCoplanarWithAll(track.sightings, newest, plane, *graph)) continue;
    taken[match.plane] = true;
    if (track.id) {
      addObservation(*track.id, config_.kernel_chi2, &sighting, graph);
      changed = true;
    }
    extend(sighting, *graph, &track);
    track.seen_at_m = way.way_m();
  }
  for (std::size_t k = 0; k < planes->size(); ++k) {
    if (taken[k] || !isWallLike((*planes)[k], T_map_base)) continue;
    begin({sightingOf(newest, planes, k, 0.0)}, T_map_base * (*planes)[k].plane_base, way.way_m(),
          *graph);
  }
  lookThrough(newest, *graph);
  if (giveUpFurniture(graph)) changed = true;
  if (promote(graph)) changed = true;
  forgetUnseen(way.way_m());
  losses_ = graph->losses();
  return changed;
}

TrackNumber WallLayer::begin(std::vector<SurfaceSighting> sightings, const Plane& plane_map,
                             double seen_at_m, const LayeredGraph& graph) {
  WallTrack track;
  track.plane_map = plane_map;
  track.sightings = std::move(sightings);
  track.seen_at_m = seen_at_m;
  redraw(config_.cell_m, graph, &track);
  track.see_through = SeeThrough(track.extent.frame());
  tracks_.emplace(next_, std::move(track));
  return next_++;
}

bool WallLayer::promote(LayeredGraph* graph) {
  bool changed = false;
  for (auto& [number, track] : tracks_) {
    if (track.id || track.is_furniture || keyframesOf(track.sightings) < config_.min_sightings) continue;
    if (track.extent.area_m2() < config_.min_wall_area_m2) continue;
    track.id = graph->addWall(track.plane_map, {});
    for (SurfaceSighting& sighting : track.sightings) {
      addObservation(*track.id, config_.kernel_chi2, &sighting, graph);
    }
    track.grown = true;
    changed = true;
  }
  return changed;
}

void WallLayer::forgetUnseen(double way_m) {
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    const bool forgotten =
        !track->second.id && way_m - track->second.seen_at_m > config_.forget_after_m;
    track = forgotten ? tracks_.erase(track) : std::next(track);
  }
}

void WallLayer::letPlanesGo(const std::vector<KeyframeId>& keyframes, const LayeredGraph& graph) {
  const std::set<KeyframeId> going(keyframes.begin(), keyframes.end());
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    WallTrack& track = entry->second;
    letGo(going, config_.cell_m, graph, &track);
    const bool gone = !track.id && track.sightings.empty();
    entry = gone ? tracks_.erase(entry) : std::next(entry);
  }
}

void WallLayer::refreshPlanes(const LayeredGraph& graph) {
  for (auto& [number, track] : tracks_) {
    updateFloor(graph, &track);
    if (track.id) {
      track.plane_map = graph.plane(*track.id);
    } else {
      track.plane_map = fitted(summed(track.sightings, track.plane_map, track.anchor_map, graph),
                               track.plane_map);
    }
  }
}

void WallLayer::dropErased(LayeredGraph* graph) {
  if (graph->losses() == losses_) return;
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    WallTrack& track = entry->second;
    mrpt_sgraphs::dropErased(*graph, &track.sightings);
    bool gone = track.id ? !graph->contains(*track.id) : track.sightings.empty();
    if (!gone && track.id && graph->factorCountOf(*track.id) == 0 &&
        graph->shelf().of(*track.id).empty()) {
      graph->eraseNode(*track.id);
      gone = true;
    }
    entry = gone ? tracks_.erase(entry) : std::next(entry);
  }
  for (auto pair = pairs_.begin(); pair != pairs_.end();) {
    pair = graph->contains(pair->second) ? std::next(pair) : pairs_.erase(pair);
  }
  losses_ = graph->losses();
}

}  // namespace mrpt_sgraphs
