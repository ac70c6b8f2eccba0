// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "walls_of_floors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace mrpt_sgraphs {
namespace {

/// How far a value is outside of an interval.
double outside(double value, double least, double most) {
  return std::max({0.0, least - value, value - most});
}

}  // namespace

std::optional<std::size_t> floorOfWall(const WallNode& wall, const LevelPlaces& places) {
  // A storey up is farther than all that is seen through a corridor.
  constexpr double kOneUpIsAlong = 10.0;
  const Outline3& outline = wall.extent_map.outline;
  const Eigen::Vector3d along_map = Eigen::Vector3d::UnitZ().cross(wall.plane_map.normal);
  if (outline.empty() || along_map.norm() < 0.5) return std::nullopt;
  Eigen::AlignedBox2d box;  // along the wall, up
  const auto inWall = [&along_map](const Eigen::Vector3d& point_map) {
    return Eigen::Vector2d(along_map.normalized().dot(point_map), point_map.z());
  };
  for (const Eigen::Vector3d& corner : outline) box.extend(inWall(corner));
  Eigen::Vector3d middle_map = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : outline) middle_map += corner;
  middle_map /= static_cast<double>(outline.size());
  middle_map.z() = box.center().y();

  std::optional<std::size_t> floor;
  double least = std::numeric_limits<double>::infinity();
  for (const LevelPlace& place : places) {
    const double front_m = wall.plane_map.normal.dot(place.base_map) - wall.plane_map.distance;
    if (front_m < 0.0) continue;
    if (place.ground_map.normal.dot(middle_map) < place.ground_map.distance) continue;
    const Eigen::Vector2d at = inWall(place.base_map);
    const Eigen::Vector3d way(front_m, outside(at.x(), box.min().x(), box.max().x()),
                              kOneUpIsAlong * outside(at.y(), box.min().y(), box.max().y()));
    if (way.squaredNorm() >= least) continue;
    least = way.squaredNorm();
    floor = place.level;
  }
  return floor;
}

}  // namespace mrpt_sgraphs
