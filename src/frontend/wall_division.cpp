// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/wall_division.h"

#include <cmath>

#include "mrpt_sgraphs/frontend/wall_layer.h"

namespace mrpt_sgraphs {
namespace {

/// Walls that meet at less than 30 degrees do not divide each other.
constexpr double kMaxCosine = 0.87;
/// Extents are drawn in cells and end within them; and either face of the dividing wall may be the
/// one that is known.
constexpr double kThickness_m = 0.4;
/// A dividing wall comes this near, and reaches this far: more than a pillar or a cabinet [m].
constexpr double kFoot_m = 0.4;
constexpr double kReach_m = 1.0;
/// So much of it is seen near and far [m^2].
constexpr double kEnough_m2 = 0.1;

}  // namespace

std::optional<WallDivision> WallDivision::of(const PlaneFrame& frame_map,
                                             const WallTrack& crossing) {
  const Eigen::Vector3d& normal = crossing.plane_map.normal;
  if (std::abs(normal.dot(frame_map.normal)) > kMaxCosine) return std::nullopt;
  const double along_u = normal.dot(frame_map.u);
  if (std::abs(along_u) < 1.0 - kMaxCosine) return std::nullopt;
  double foot_m2 = 0.0;
  double reach_m2 = 0.0;
  crossing.extent.forEachCell([&](const Eigen::Vector3d& centre_map, double area_m2) {
    const double height_m = frame_map.normal.dot(centre_map - frame_map.origin);
    if (std::abs(height_m) < kFoot_m) foot_m2 += area_m2;
    if (height_m > kReach_m) reach_m2 += area_m2;
  });
  if (foot_m2 < kEnough_m2 || reach_m2 < kEnough_m2) return std::nullopt;
  WallDivision division;
  division.frame_ = frame_map;
  division.at_m_ =
      (crossing.plane_map.distance - normal.dot(frame_map.origin)) / along_u;
  return division;
}

int WallDivision::sideOf(const WallExtent& extent) const {
  Eigen::AlignedBox2d box;
  extent.forEachCorner([&](const Eigen::Vector3d& corner_map) {
    box.extend(frame_.flat(corner_map));
  });
  if (box.max().x() < at_m_ + kThickness_m && box.center().x() < at_m_) return -1;
  if (box.min().x() > at_m_ - kThickness_m && box.center().x() > at_m_) return 1;
  return 0;
}

bool WallLayer::isDivided(const WallExtent& a, const WallExtent& b) const {
  Eigen::AlignedBox3d box = a.box_map().merged(b.box_map());
  for (const auto& [number, crossing] : tracks_) {
    if (crossing.is_furniture || !crossing.box_map.intersects(box)) continue;
    const auto division = WallDivision::of(a.frame(), crossing);
    if (division && division->sideOf(a) * division->sideOf(b) < 0) return true;
  }
  return false;
}

std::vector<SurfaceSighting> WallLayer::beyondDivision(const WallTrack& track,
                                                       const LayeredGraph& graph) const {
  for (const auto& [number, crossing] : tracks_) {
    if (crossing.is_furniture || !crossing.id || !crossing.box_map.intersects(track.box_map)) continue;
    const auto division = WallDivision::of(track.extent.frame(), crossing);
    if (!division || division->sideOf(track.extent) != 0) continue;
    std::vector<SurfaceSighting> sides[2];
    bool is_divided = true;
    for (const SurfaceSighting& sighting : track.sightings) {
      const int side = division->sideOf(track.extent.drawn(
          graph.pose(sighting.keyframe) * observedBy(sighting, graph).extent_base));
      if (side == 0) is_divided = false;
      sides[side < 0 ? 0 : 1].push_back(sighting);
    }
    if (!is_divided || sides[0].empty() || sides[1].empty()) continue;
    return sides[sides[0].size() < sides[1].size() ? 0 : 1];
  }
  return {};
}

}  // namespace mrpt_sgraphs
