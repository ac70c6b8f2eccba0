// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/ground_layer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

namespace mrpt_sgraphs {
namespace {

/// Where the vertical through the base's origin meets the plane, above it [m].
double heightUnderBase(const Plane& plane_base, const Eigen::Vector3d& up_base) {
  return plane_base.distance / plane_base.normal.dot(up_base);
}

}  // namespace

Eigen::Vector3d GroundLayer::up_map(const LayeredGraph& graph) const {
  for (const Level& level : levels_) {
    if (level.id && graph.contains(*level.id)) return graph.plane(*level.id).normal;
  }
  return Eigen::Vector3d::UnitZ();
}

std::optional<std::size_t> GroundLayer::groundAmong(const ObservedPlanes& planes,
                                                    const Eigen::Vector3d& up_base) const {
  const bool has_level = std::any_of(levels_.begin(), levels_.end(),
                                     [](const Level& level) { return level.id.has_value(); });
  const double least_up = std::cos(has_level ? config_.max_tilt_rad : config_.max_map_tilt_rad);
  std::optional<std::size_t> ground;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const ObservedPlane& plane = planes[k];
    if (plane.area_m2 < config_.min_area_m2 || !canBeSighted(plane)) continue;
    if (plane.plane_base.normal.dot(up_base) < least_up) continue;
    const double height_m = heightUnderBase(plane.plane_base, up_base);
    if (height_m > config_.max_step_m) continue;  // nothing to stand on
    // at first the lowest one
    const double off_m = standing_ ? std::abs(height_m - standing_->height_m) : height_m;
    if ((standing_ && off_m > config_.max_step_m) || off_m >= least) continue;
    least = off_m;
    ground = k;
  }
  return ground;
}

void GroundLayer::stand(double height_m, double way_m) {
  // Slowly: on stairs the floor below falls behind step by step, and must not take the height
  // along.
  constexpr double kShare = 0.05;
  if (!standing_) standing_ = Standing{height_m, way_m};
  standing_->height_m += kShare * (height_m - standing_->height_m);
  standing_->seen_at_m = way_m;
}

GroundLayer::Level* GroundLayer::levelOf(const ObservedPlane& ground, const WayToNewest& way,
                                         const LayeredGraph& graph) {
  Level* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Level& level : levels_) {
    const SurfaceFit fit = fitOf(ground, graph.pose(way.newest()), level, config_.floor,
                                 way.uncertaintyFrom(level.sightings, graph));
    if (fit.chi2 > config_.max_chi2 || std::abs(fit.offset_m) > config_.max_offset_m) continue;
    if (fit.surprise >= least) continue;
    least = fit.surprise;
    best = &level;
  }
  return best;
}

bool GroundLayer::associate(const WayToNewest& way, LayeredGraph* graph) {
  const KeyframeId newest = way.newest();
  const ObservedPlanesConstPtr planes = graph->attributes(newest).planes;
  if (planes == nullptr) return false;
  if (standing_ && way.way_m() - standing_->seen_at_m > config_.forget_after_m) standing_.reset();
  const Eigen::Vector3d up_base = graph->pose(newest).linear().transpose() * up_map(*graph);
  const std::optional<std::size_t> index = groundAmong(*planes, up_base);
  if (!index) return false;
  const ObservedPlane& ground = (*planes)[*index];
  stand(heightUnderBase(ground.plane_base, up_base), way.way_m());

  refreshPlanes(*graph);
  SurfaceSighting sighting = sightingOf(newest, planes, *index, 0.0);
  Level* level = levelOf(ground, way, *graph);
  if (level == nullptr) {
    levels_.emplace_back();
    level = &levels_.back();
    level->plane_map = graph->pose(newest) * ground.plane_base;
    level->sightings = {sighting};
    refit(*graph, level);
  } else {
    if (level->id) addFactor(&sighting, *level->id, graph);
    addSighting(sighting, *graph, level);
  }
  level->seen_at_m = way.way_m();
  if (!level->id && isWideEnough(*level, *graph)) {
    level->id = graph->addFloor(level->plane_map, {});
    for (SurfaceSighting& other : level->sightings) addFactor(&other, *level->id, graph);
  }
  const bool changed = level->id.has_value();
  if (changed) updateFloor(*level, graph);
  levels_.erase(std::remove_if(levels_.begin(), levels_.end(),
                               [&](const Level& other) {
                                 return !other.id &&
                                        way.way_m() - other.seen_at_m > config_.forget_after_m;
                               }),
                levels_.end());
  return changed;
}

bool GroundLayer::isWideEnough(const Level& level, const LayeredGraph& graph) const {
  if (keyframesOf(level.sightings) < config_.min_sightings) return false;
  if (graph.size(Layer::kFloor) == 0) return true;  // the robot has come by no stairs
  Eigen::AlignedBox3d box_map;
  for (const SurfaceSighting& sighting : level.sightings) {
    box_map.extend(graph.pose(sighting.keyframe).translation());
  }
  return box_map.diagonal().norm() >= config_.min_spread_m;
}

bool GroundLayer::merge(FloorId stays, FloorId goes, LayeredGraph* graph) {
  refreshPlanes(*graph);
  const auto levelWith = [this](FloorId id) {
    return std::find_if(levels_.begin(), levels_.end(),
                        [id](const Level& level) { return level.id == id; });
  };
  const auto level = levelWith(stays);
  const auto other = levelWith(goes);
  if (level == levels_.end() || other == levels_.end() || stays == goes) return false;
  replaceSurface(goes, stays, config_.kernel_chi2, &other->sightings, graph);
  for (const SurfaceSighting& sighting : other->sightings) {
    setFloor(sighting.keyframe, stays, graph);
  }
  level->sightings = mergedByKeyframe(level->sightings, other->sightings);
  level->seen_at_m = std::max(level->seen_at_m, other->seen_at_m);
  refit(*graph, &*level);
  graph->setPlane(stays, level->plane_map);
  updateFloor(*level, graph);
  levels_.erase(other);
  return true;
}

void GroundLayer::refreshPlanes(const LayeredGraph& graph) {
  for (Level& level : levels_) dropErased(graph, &level.sightings);
  const auto is_gone = [&graph](const Level& level) {
    return level.sightings.empty() || (level.id && !graph.contains(*level.id));
  };
  levels_.erase(std::remove_if(levels_.begin(), levels_.end(), is_gone), levels_.end());
  for (Level& level : levels_) {
    if (level.id) {
      level.plane_map = graph.plane(*level.id);
    } else {
      refit(graph, &level);
    }
  }
}

void GroundLayer::addFactor(SurfaceSighting* sighting, FloorId floor, LayeredGraph* graph) const {
  addObservation(floor, config_.kernel_chi2, sighting, graph);
  setFloor(sighting->keyframe, floor, graph);
}

void GroundLayer::setFloor(KeyframeId keyframe, FloorId floor, LayeredGraph* graph) {
  KeyframeAttributes attributes = graph->attributes(keyframe);
  attributes.floor = floor;
  graph->setAttributes(keyframe, attributes);
}

void GroundLayer::letPlanesGo(const std::vector<KeyframeId>& keyframes) {
  const std::set<KeyframeId> going(keyframes.begin(), keyframes.end());
  for (Level& level : levels_) {
    for (SurfaceSighting& sighting : level.sightings) {
      if (going.count(sighting.keyframe) > 0) letGo(&sighting);
    }
  }
}

void GroundLayer::updateFloor(const Level& level, LayeredGraph* graph) const {
  Eigen::Vector3d centre_map = Eigen::Vector3d::Zero();
  for (const SurfaceSighting& sighting : level.sightings) {
    centre_map +=
        graph->pose(sighting.keyframe).translation() / static_cast<double>(level.sightings.size());
  }
  const Plane ground_map = graph->plane(*level.id);
  centre_map -= (ground_map.normal.dot(centre_map) - ground_map.distance) * ground_map.normal;
  FloorAttributes attributes = graph->attributes(*level.id);
  attributes.centre_map = centre_map;
  graph->setAttributes(*level.id, attributes);
}

}  // namespace mrpt_sgraphs
