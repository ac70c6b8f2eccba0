// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// The two faces of one wall.

#include <cmath>
#include <limits>
#include <memory>

#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {

bool WallLayer::updatePairs(LayeredGraph* graph) {
  bool changed = false;
  for (const auto& [number, track] : tracks_) {
    if (!track.id || !track.grown) continue;
    for (const auto& [other, face] : tracks_) {
      if (!face.id || other == number) continue;
      const auto pair = std::minmax(number, other);
      if (pairs_.count(pair) != 0 || !isPair(track, face)) continue;
      pairs_[pair] = addPair(tracks_.at(pair.first), tracks_.at(pair.second), graph);
      changed = true;
    }
  }
  return changed;
}

bool WallLayer::isPair(const WallTrack& a, const WallTrack& b) const {
  if (-a.plane_map.normal.dot(b.plane_map.normal) < std::cos(config_.pair_max_angle_rad)) {
    return false;
  }
  if (a.box_map.exteriorDistance(b.box_map) > 2.0 * config_.pair_max_thickness_m) return false;
  // against the normal from the one to the other, where both are
  const Eigen::Vector3d middle_map = 0.5 * (a.extent.centre_map() + b.extent.centre_map());
  const double thickness_m = a.plane_map.distance + b.plane_map.distance -
                             (a.plane_map.normal + b.plane_map.normal).dot(middle_map);
  return thickness_m >= config_.pair_min_thickness_m &&
         thickness_m <= config_.pair_max_thickness_m &&
         a.extent.sharedArea_m2(b.extent) >= config_.pair_min_area_m2;
}

FactorId WallLayer::addPair(const WallTrack& a, const WallTrack& b, LayeredGraph* graph) const {
  // The keyframe nearest to the middle says where the thickness is: faces that are not quite
  // parallel have another one elsewhere.
  const Eigen::Vector3d middle_map = 0.5 * (a.extent.centre_map() + b.extent.centre_map());
  KeyframeId nearest;
  double least_m = std::numeric_limits<double>::infinity();
  for (const WallTrack* face : {&a, &b}) {
    for (const SurfaceSighting& sighting : face->sightings) {
      const double distance_m = (graph->pose(sighting.keyframe).translation() - middle_map).norm();
      if (distance_m >= least_m) continue;
      least_m = distance_m;
      nearest = sighting.keyframe;
    }
  }
  nearest = graph->attributes(nearest).representative.value_or(nearest);
  const Pose T_map_base = graph->pose(nearest);
  const Plane a_base = inverseTimes(T_map_base, a.plane_map);
  const Plane b_base = inverseTimes(T_map_base, b.plane_map);
  const double per_rad2 = 1.0 / (config_.pair_sigma_rad * config_.pair_sigma_rad);
  const double per_m2 = 1.0 / (config_.pair_sigma_m * config_.pair_sigma_m);
  const Eigen::Matrix3d information = Eigen::Vector3d(per_rad2, per_rad2, per_m2).asDiagonal();
  const RobustKernel doubt{RobustKernel::Kind::kCauchy, config_.pair_kernel_chi2};
  return graph->addFactor(std::make_shared<WallPairFactor>(
      nearest, *a.id, *b.id, a_base.normal, a_base.distance + b_base.distance, information, doubt));
}

void WallLayer::erasePairsOf(TrackNumber number, LayeredGraph* graph) {
  for (auto pair = pairs_.begin(); pair != pairs_.end();) {
    if (pair->first.first != number && pair->first.second != number) {
      ++pair;
      continue;
    }
    if (graph->contains(pair->second)) graph->eraseFactor(pair->second);
    pair = pairs_.erase(pair);
  }
}

}  // namespace mrpt_sgraphs
