// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lidar.h"

#include <cmath>

namespace mrpt_sgraphs::sim {
namespace {

/// Beyond 85 degrees of incidence echoes get lost, all of them at 90.
const double kGrazingCosine = std::cos(85.0 * M_PI / 180.0);
constexpr double kFullIntensity = 100.0;
constexpr double kSecondsPerNs = 1e-9;

}  // namespace

Lidar::Lidar(const LidarModel& model, const Pose& T_base_lidar, const Scene& scene,
             const Trajectory& trajectory, uint64_t seed)
    : model_(model),
      T_base_lidar_(T_base_lidar),
      scene_(scene),
      trajectory_(trajectory),
      random_(seed, Random::Stream::kLidar) {
  for (int ring = 0; ring < model.rings; ++ring)
    beams_.push_back(direction(model.elevation_rad(ring)));
}

int64_t Lidar::startOf_ns(int64_t index) const {
  return std::llround(static_cast<double>(index) / model_.rate_hz / kSecondsPerNs);
}

LidarScan Lidar::scan(int64_t index, SeenWalls* seen) {
  LidarScan scan;
  scan.start_ns = startOf_ns(index);
  scan.period_ns = startOf_ns(index + 1) - scan.start_ns;
  scan.returns.reserve(beams_.size() * static_cast<size_t>(model_.columns));
  for (int column = 0; column < model_.columns; ++column) fireColumn(column, scan, seen);
  return scan;
}

void Lidar::fireColumn(int column, LidarScan& scan, SeenWalls* seen) {
  const int64_t offset_ns = scan.period_ns * column / model_.columns;
  const double time_s = static_cast<double>(scan.start_ns + offset_ns) * kSecondsPerNs;
  const Pose T_map_base = trajectory_.T_map_base(time_s);
  const Pose T_map_lidar = T_map_base * T_base_lidar_;
  const std::vector<Cylinder> people = scene_.peopleAt(time_s, T_map_base.translation());
  const Eigen::Vector2d azimuth = direction(M_PI - 2.0 * M_PI * column / model_.columns);

  for (size_t ring = 0; ring < beams_.size(); ++ring) {
    const Eigen::Vector3d beam_lidar(beams_[ring].x() * azimuth.x(), beams_[ring].x() * azimuth.y(),
                                     beams_[ring].y());
    const Ray ray{T_map_lidar.translation(), T_map_lidar.linear() * beam_lidar};
    const std::optional<Hit> hit = scene_.cast(ray, model_.max_range_m, people);
    if (!hit || !hit->material.returns || hit->range_m < model_.min_range_m) continue;

    const double cosine = std::abs(hit->normal.dot(ray.direction));
    if (cosine < kGrazingCosine && random_.uniform() > cosine / kGrazingCosine) continue;
    if (random_.uniform() < model_.dropout) continue;
    if (seen != nullptr) seen->add(ray, *hit);

    const double range_m = hit->range_m + model_.noise_m * random_.gaussian();
    LidarReturn echo;
    echo.point_lidar = (range_m * beam_lidar).cast<float>();
    echo.range_m = static_cast<float>(range_m);
    echo.intensity =
        static_cast<float>(std::round(kFullIntensity * hit->material.reflectivity * cosine));
    echo.offset_ns = static_cast<uint32_t>(offset_ns);
    echo.ring = static_cast<uint16_t>(ring);
    echo.column = static_cast<uint16_t>(column);
    scan.returns.push_back(echo);
  }
}

}  // namespace mrpt_sgraphs::sim
