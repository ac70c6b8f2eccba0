// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scene.h"

#include <cmath>

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kPersonRadius_m = 0.25;
constexpr double kPersonHeight_m = 1.75;
constexpr Material kClothes{0.4, true};
/// People step aside so that this much remains between their axis and the robot's.
constexpr double kPersonalSpace_m = 0.9;
/// A person on another storey is not in the way, and behind a slab anyway.
constexpr double kSameStorey_m = 1.5;

/// To and fro between `from` and `to` at constant speed.
Eigen::Vector2d positionOnBeat(const Person& person, double time_s) {
  const double length_m = (person.to - person.from).norm();
  if (length_m == 0.0) return person.from;
  const double s = std::fmod(person.speed_m_s * time_s, 2.0 * length_m) / length_m;
  return person.from + (s < 1.0 ? s : 2.0 - s) * (person.to - person.from);
}

}  // namespace

Scene::Scene(const Building& building) : still_(stillShapes(building)) {
  for (const Person& person : building.people) {
    walkers_.push_back({person, building.storeys[person.storey].elevation_m});
  }
}

std::vector<Cylinder> Scene::peopleAt(double time_s, const Eigen::Vector3d& robot_map) const {
  std::vector<Cylinder> people;
  people.reserve(walkers_.size());
  for (const Walker& walker : walkers_) {
    Eigen::Vector2d position = positionOnBeat(walker.person, time_s);
    const Eigen::Vector2d away = position - robot_map.head<2>();
    const bool near =
        away.norm() < kPersonalSpace_m && std::abs(robot_map.z() - walker.floor_m) < kSameStorey_m;
    if (near) position = robot_map.head<2>() + kPersonalSpace_m * away.stableNormalized();
    people.emplace_back(position, kPersonRadius_m, walker.floor_m, walker.floor_m + kPersonHeight_m,
                        kClothes);
  }
  return people;
}

std::optional<Hit> Scene::cast(const Ray& ray_map, double max_range_m,
                               const std::vector<Cylinder>& people) const {
  std::optional<Hit> hit = still_.cast(ray_map, max_range_m);
  Hit nearest;
  nearest.range_m = hit ? hit->range_m : max_range_m;
  for (const Cylinder& person : people) {
    if (person.intersect(ray_map, nearest)) hit = nearest;
  }
  return hit;
}

}  // namespace mrpt_sgraphs::sim
