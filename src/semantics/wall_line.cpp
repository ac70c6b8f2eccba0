// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "wall_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_sgraphs {
namespace {

constexpr double kMaxTilt = 0.3;  ///< Of a wall's normal, its sine: nothing that leans more is one.

/// Walls whose lines lie within these are in one line.
constexpr double kOneLine_m = 0.15;
constexpr double kOneLine_rad = 0.06;

std::optional<WallLine> lineOf(const WallNode& wall, const Pose& T_floor_map, const Slab& slab) {
  const Plane plane = T_floor_map * wall.plane_map;
  const double level = plane.normal.head<2>().norm();
  if (std::abs(plane.normal.z()) > kMaxTilt || wall.extent_map.outline.empty()) return std::nullopt;
  const double infinity = std::numeric_limits<double>::infinity();
  WallLine drawn{wall.id, {plane.normal.head<2>() / level, 0.0}, infinity, -infinity, -infinity,
                 {}};
  const auto flat = [&](const Outline3& ring_map) {
    Outline2 ring;
    for (const Eigen::Vector3d& corner_map : ring_map) {
      const Eigen::Vector3d corner = T_floor_map * corner_map;
      ring.emplace_back(drawn.line.along().dot(corner.head<2>()), corner.z());
    }
    return ring;
  };
  drawn.extent.outline = flat(wall.extent_map.outline);
  for (const Outline3& hole : wall.extent_map.holes) drawn.extent.holes.push_back(flat(hole));
  double bottom_m = infinity;
  for (const Eigen::Vector2d& corner : drawn.extent.outline) {
    bottom_m = std::min(bottom_m, corner.y());
    drawn.top_m = std::max(drawn.top_m, corner.y());
    drawn.begin_m = std::min(drawn.begin_m, corner.x());
    drawn.end_m = std::max(drawn.end_m, corner.x());
  }
  // most of the slab, as the smallest walls that one cannot look over
  const double shared_m = std::min(drawn.top_m, slab.top_m) - std::max(bottom_m, slab.bottom_m);
  if (shared_m < 0.5 * (slab.top_m - slab.bottom_m)) return std::nullopt;
  const double middle_m = 0.5 * (slab.bottom_m + slab.top_m);
  drawn.line.distance = (plane.distance - plane.normal.z() * middle_m) / level;
  return drawn;
}

/// How far along `wall` its line crosses `other`, if it does within reach of it.
std::optional<double> crossing(const WallLine& wall, const WallLine& other) {
  constexpr double kReach_m = 0.3;  // the corner of two walls is often not seen
  const Eigen::Vector2d along = wall.line.along();
  const double slope = other.line.normal.dot(along);
  if (std::abs(slope) < 0.2) return std::nullopt;
  const Eigen::Vector2d foot = wall.at(0.0);
  const double at_m = -other.line.heightOf(foot) / slope;
  const double on_other_m = other.line.along().dot(foot + at_m * along);
  const bool is_met = on_other_m > other.begin_m - kReach_m && on_other_m < other.end_m + kReach_m;
  return is_met ? std::optional<double>(at_m) : std::nullopt;
}

/// The gap to a wall that goes on in the same line, and where that one begins; the wall looks in
/// the direction of its line or, with -1, against it.
std::optional<double> continuation(const WallLine& wall, const WallLine& other, double direction) {
  const double cosine = wall.line.normal.dot(other.line.normal);
  if (std::abs(cosine) < std::cos(kOneLine_rad)) return std::nullopt;
  const Eigen::Vector2d end = wall.at(direction > 0.0 ? wall.end_m : wall.begin_m);
  double nearest = std::numeric_limits<double>::infinity();
  for (const double on_other_m : {other.begin_m, other.end_m}) {
    const Eigen::Vector2d point = other.at(on_other_m);
    if (std::abs(wall.line.heightOf(point)) > kOneLine_m) return std::nullopt;
    nearest = std::min(nearest, direction * wall.line.along().dot(point - end));
  }
  return nearest > 0.0 ? std::optional<double>(nearest) : std::nullopt;
}

}  // namespace

std::vector<WallLine> wallLinesOf(const SharedVector<WallNode>& walls,
                                  const std::optional<FloorId>& floor, const Pose& T_floor_map,
                                  const Slab& slab) {
  std::vector<WallLine> lines;
  for (const WallNode& wall : walls) {
    if (floor && wall.floor && *wall.floor != *floor) continue;
    if (const auto line = lineOf(wall, T_floor_map, slab)) lines.push_back(*line);
  }
  return lines;
}

std::vector<WallLine> barriersOf(const std::vector<WallLine>& walls, double max_door_m,
                                 double max_passage_m) {
  std::vector<WallLine> barriers = walls;
  for (WallLine& barrier : barriers) {
    const WallLine wall = barrier;
    double before_m = std::numeric_limits<double>::infinity();
    double after_m = before_m;
    for (const WallLine& other : walls) {
      if (other.id == wall.id) continue;
      if (const auto at_m = crossing(wall, other)) {
        if (*at_m > wall.end_m && *at_m - wall.end_m < max_door_m) {
          after_m = std::min(after_m, *at_m - wall.end_m);
        }
        if (*at_m < wall.begin_m && wall.begin_m - *at_m < max_door_m) {
          before_m = std::min(before_m, wall.begin_m - *at_m);
        }
      }
      for (const double direction : {1.0, -1.0}) {
        const auto gap_m = continuation(wall, other, direction);
        if (!gap_m || *gap_m > max_passage_m) continue;
        double& reach_m = direction > 0.0 ? after_m : before_m;
        reach_m = std::min(reach_m, *gap_m);
      }
    }
    if (std::isfinite(after_m)) barrier.end_m += after_m;
    if (std::isfinite(before_m)) barrier.begin_m -= before_m;
  }
  return barriers;
}

}  // namespace mrpt_sgraphs
