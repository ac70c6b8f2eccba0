// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// Walls that are two.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {
namespace {

/// The chi2 of each sighting with a plane, the keyframes as they are.
std::vector<double> chi2Of(const std::vector<SurfaceSighting>& sightings, const Plane& plane_map,
                           const LayeredGraph& graph) {
  std::vector<double> chi2;
  for (const SurfaceSighting& sighting : sightings) {
    const PlaneObservationFactor observation = observationOf(sighting, WallId{}, graph);
    chi2.push_back(observation.chi2(graph.pose(sighting.keyframe), plane_map));
  }
  return chi2;
}

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<SurfaceSighting> those(const std::vector<SurfaceSighting>& sightings,
                                   const std::vector<bool>& wanted, bool value) {
  std::vector<SurfaceSighting> result;
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    if (wanted[k] == value) result.push_back(sightings[k]);
  }
  return result;
}

/// Those that may leave a track: of what was let go of, only the track as a whole knows how far it
/// was seen.
std::vector<SurfaceSighting> movable(const std::vector<SurfaceSighting>& sightings) {
  std::vector<SurfaceSighting> result;
  std::copy_if(sightings.begin(), sightings.end(), std::back_inserter(result),
               [](const SurfaceSighting& sighting) { return sighting.observed != nullptr; });
  return result;
}

/// The sightings in front of the best cut between two groups, by where their centroids lie across
/// the plane: the cut that leaves the least squares (Otsu).
std::vector<bool> inFront(const std::vector<SurfaceSighting>& sightings, const Plane& plane_map,
                          const LayeredGraph& graph) {
  std::vector<double> offsets_m;
  for (const SurfaceSighting& sighting : sightings) {
    const Eigen::Vector3d centroid_map =
        graph.pose(sighting.keyframe) * measuredBy(sighting, graph).centroid_base;
    offsets_m.push_back(plane_map.normal.dot(centroid_map) - plane_map.distance);
  }
  std::vector<double> sorted = offsets_m;
  std::sort(sorted.begin(), sorted.end());
  const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  const double count = static_cast<double>(sorted.size());
  double cut = -std::numeric_limits<double>::infinity();
  double best = -1.0;
  double below = 0.0;
  for (std::size_t k = 0; k + 1 < sorted.size(); ++k) {
    below += sorted[k];
    const double n = static_cast<double>(k + 1);
    const double apart = below / n - (total - below) / (count - n);
    const double between = n * (count - n) * apart * apart;
    if (between <= best) continue;
    best = between;
    cut = 0.5 * (sorted[k] + sorted[k + 1]);
  }
  std::vector<bool> front;
  for (const double offset_m : offsets_m) front.push_back(offset_m > cut);
  return front;
}

}  // namespace

void WallLayer::release(LayeredGraph* graph) {
  dropErased(graph);
  refreshPlanes(*graph);
  std::vector<TrackNumber> numbers;
  for (const auto& [number, track] : tracks_) numbers.push_back(number);
  for (TrackNumber number : numbers) {
    // from one doubtful sighting to the next they followed each other
    const auto is_doubtful = [this](const SurfaceSighting& sighting) {
      return sighting.way_sigma_m > config_.doubtful_way_m;
    };
    for (bool more = true; more;) {
      std::vector<SurfaceSighting>& sightings = tracks_.at(number).sightings;
      const auto doubtful = std::find_if(sightings.begin(), sightings.end(), is_doubtful);
      more = doubtful != sightings.end();
      if (!more) break;
      doubtful->way_sigma_m = 0.0;
      if (doubtful == sightings.begin()) continue;
      const std::vector<SurfaceSighting> leaving = movable({doubtful, sightings.end()});
      if (!leaving.empty()) number = split(number, leaving, graph);
    }
  }
  promote(graph);
  losses_ = graph->losses();
}

bool WallLayer::splitTracks(LayeredGraph* graph) {
  std::vector<TrackNumber> grown;
  for (const auto& [number, track] : tracks_) {
    if (track.grown || track.is_on_more) grown.push_back(number);
  }
  bool changed = false;
  for (const TrackNumber number : grown) {
    const std::vector<SurfaceSighting> strangers =
        movable(strangersIn(tracks_.at(number), *graph));
    if (strangers.empty()) continue;
    changed = changed || tracks_.at(number).id;
    split(number, strangers, graph);
  }
  return changed;
}

std::vector<SurfaceSighting> WallLayer::strangersIn(const WallTrack& track,
                                                    const LayeredGraph& graph) const {
  const std::vector<SurfaceSighting>& all = track.sightings;
  if (all.size() < 2) return {};
  if (track.is_on_more) {  // a wall of each storey, however well they line up
    std::vector<bool> on_other;
    for (const SurfaceSighting& sighting : all) {
      on_other.push_back(areApart(floorOf(sighting, graph), track.floor));
    }
    return those(all, on_other, true);
  }

  std::vector<WallExtent> pieces;  // as they were, where the outline is
  if (!track.outline_map) pieces = track.extent.pieces(config_.max_gap_m);
  if (pieces.size() > 1) {
    std::vector<bool> in_largest;
    for (const SurfaceSighting& sighting : all) {
      const WallExtent seen = sighting.observed == nullptr
                                  ? WallExtent()
                                  : track.extent.drawn(graph.pose(sighting.keyframe) *
                                                       sighting.observed->extent_base);
      in_largest.push_back(seen.empty() || seen.overlaps(pieces.front()));
    }
    return those(all, in_largest, false);
  }

  const double before = meanOf(chi2Of(all, track.plane_map, graph));
  if (before < config_.split_chi2) return {};
  std::vector<bool> front = inFront(all, track.plane_map, graph);
  std::vector<SurfaceSighting> groups[2];
  Plane planes_map[2];
  double after = 0.0;
  constexpr int kRounds = 5;  // each sighting to the plane that it fits better, and again
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> chi2[2];
    for (const int side : {0, 1}) {
      groups[side] = those(all, front, side == 1);
      if (keyframesOf(groups[side]) < config_.min_sightings) return {};
      planes_map[side] =
          fitted(summed(groups[side], track.plane_map, track.anchor_map, graph), track.plane_map);
      chi2[side] = chi2Of(all, planes_map[side], graph);
    }
    after = 0.0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      after += chi2[front[k] ? 1 : 0][k];
      if (round + 1 < kRounds) front[k] = chi2[1][k] < chi2[0][k];
    }
  }
  // Two planes fit any sightings better than one: they have to explain what one cannot, and to be
  // as far apart as two surfaces are and a bulging one is not.
  constexpr double kExplained = 30.0;
  const double gain = before * static_cast<double>(all.size()) - after;
  const Eigen::Vector3d middle_map = track.extent.centre_map();
  const double apart_m = std::abs(planes_map[0].normal.dot(middle_map) - planes_map[0].distance -
                                  planes_map[1].normal.dot(middle_map) + planes_map[1].distance);
  if (gain < kExplained || apart_m < kSameSurface_m) return {};
  return groups[groups[1].size() > groups[0].size() ? 0 : 1];
}

TrackNumber WallLayer::split(TrackNumber number, const std::vector<SurfaceSighting>& leaving,
                             LayeredGraph* graph) {
  WallTrack& track = tracks_.at(number);
  std::vector<SurfaceSighting> staying;
  std::vector<SurfaceSighting> gone = leaving;
  for (const SurfaceSighting& sighting : track.sightings) {
    const bool leaves =
        std::any_of(leaving.begin(), leaving.end(), [&sighting](const SurfaceSighting& other) {
          return other.keyframe == sighting.keyframe && other.plane == sighting.plane;
        });
    if (!leaves) staying.push_back(sighting);
  }
  for (SurfaceSighting& sighting : gone) {
    if (sighting.factor) graph->eraseFactor(*sighting.factor);
    sighting.factor.reset();
  }
  erasePairsOf(number, graph);
  track.sightings = staying;
  if (track.id) {
    graph->setPlane(*track.id, fitted(summed(staying, track.plane_map, track.anchor_map, *graph),
                                      track.plane_map));
  }
  redraw(config_.cell_m, *graph, &track);
  const TrackNumber other = begin(gone, track.plane_map, track.seen_at_m, *graph);
  tracks_.at(other).apart.insert(number);
  track.apart.insert(other);
  return other;
}

}  // namespace mrpt_sgraphs
