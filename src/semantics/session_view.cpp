// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "session_view.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr std::size_t kGroundKeyframes = 5;
constexpr double kLevel = 0.95;  ///< Cosine of a ground's tilt; sessions may start tilted.
constexpr double kMinGround_m2 = 1.0;
constexpr double kBelow_m = 0.1;  ///< The base stands above its ground.
/// Keyframes whose height over the ground differs by more are on another storey, or on stairs.
constexpr double kOneLevel_m = 1.0;

double heightOver(const Plane& ground, const Eigen::Vector3d& point) {
  return ground.normal.dot(point) - ground.distance;
}

const FloorNode* floorOf(const KeyframeNode& keyframe, const GraphSnapshot& session) {
  for (const FloorNode& floor : session.floors) {
    if (keyframe.floor ? floor.id == *keyframe.floor : session.floors.size() == 1) return &floor;
  }
  return nullptr;
}

Pose viewFrame(const Plane& ground, const KeyframeNode& newest) {
  const Eigen::Vector3d heading = newest.T_map_base.linear().col(0);
  Pose T_session_view = Pose::Identity();
  const Eigen::Vector3d y = ground.normal.cross(heading).normalized();
  T_session_view.linear() << y.cross(ground.normal), y, ground.normal;
  const Eigen::Vector3d base = newest.T_map_base.translation();
  T_session_view.translation() = base - heightOver(ground, base) * ground.normal;
  return T_session_view;
}

}  // namespace

std::optional<Plane> groundOf(const GraphSnapshot& session) {
  if (session.keyframes.empty()) return std::nullopt;
  const KeyframeNode& newest = session.keyframes.back();
  if (const FloorNode* floor = floorOf(newest, session)) return floor->ground_map;
  if (!session.floors.empty()) return std::nullopt;  // on stairs

  std::optional<Plane> best;
  double best_m2 = kMinGround_m2;
  const std::size_t count = session.keyframes.size();
  for (std::size_t k = count - std::min(count, kGroundKeyframes); k < count; ++k) {
    const KeyframeNode& keyframe = session.keyframes[k];
    if (keyframe.planes == nullptr) continue;
    for (const ObservedPlane& plane : *keyframe.planes) {
      const Plane here = keyframe.T_map_base * plane.plane_base;
      if (here.normal.z() < kLevel || plane.area_m2 < best_m2) continue;
      if (heightOver(here, newest.T_map_base.translation()) < kBelow_m) continue;
      best = here;
      best_m2 = plane.area_m2;
    }
  }
  return best;
}

std::optional<SessionView> viewOf(const GraphSnapshot& session, std::size_t keyframes,
                                  const FreeSpaceConfig& config) {
  const std::optional<Plane> ground = groundOf(session);
  if (!ground || session.keyframes.back().cloud == nullptr) return std::nullopt;
  SessionView view;
  view.newest = &session.keyframes.back();
  view.T_session_view = viewFrame(*ground, *view.newest);
  const double height_m = heightOver(*ground, view.newest->T_map_base.translation());

  FreeSpace space(config);
  const Pose T_view_session = view.T_session_view.inverse();
  const std::size_t count = session.keyframes.size();
  for (std::size_t k = 0; k < count; ++k) {
    const KeyframeNode& keyframe = session.keyframes[k];
    const Eigen::Vector3d place = keyframe.T_map_base.translation();
    if (k > 0) view.way_m += (place - session.keyframes[k - 1].T_map_base.translation()).norm();
    if (k + keyframes < count || keyframe.cloud == nullptr) continue;
    if (std::abs(heightOver(*ground, place) - height_m) > kOneLevel_m) continue;
    space.add(*keyframe.cloud, T_view_session * keyframe.T_map_base);
  }
  view.plan = StoreyPlan(space, {config.min_height_m, config.max_height_m}, {}, {});
  return view;
}

}  // namespace mrpt_sgraphs
