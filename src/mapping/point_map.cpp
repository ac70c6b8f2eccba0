// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/point_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_key.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kTolerance = 0.25;  ///< Of a voxel.
constexpr double kSteps_per_m = 1e4;
constexpr float kIntensitySteps = 16.0F;
constexpr float kMaxIntensity = 1e6F;  ///< What is larger, or none, is no intensity.

std::int64_t intensityOf(const Point& point) {
  if (!(std::abs(point.intensity) < kMaxIntensity)) return 0;
  return std::llround(kIntensitySteps * point.intensity);
}

}  // namespace

PointMap::PointMap(double voxel_m) : voxel_m_(voxel_m), placed_(kTolerance * voxel_m) {}

bool PointMap::update(const GraphSnapshot& graph) {
  return placed_.update(
      graph.keyframes, Pose::Identity(),
      [this](const Cloud& cloud, const Pose& T_map_base) { count(cloud, T_map_base, 1); },
      [this](const Cloud& cloud, const Pose& T_map_base) { count(cloud, T_map_base, -1); });
}

void PointMap::count(const Cloud& cloud_base, const Pose& T_map_base, int sign) {
  for (const Point& point : cloud_base) {
    const Eigen::Vector3d at = T_map_base * point.getVector3fMap().cast<double>() / voxel_m_;
    if (!at.allFinite()) continue;
    const Eigen::Vector3d corner = at.array().floor();
    const CellKey key =
        cellKey(static_cast<std::int64_t>(corner.x()), static_cast<std::int64_t>(corner.y()),
                static_cast<std::int64_t>(corner.z()));
    Sum& sum = sums_[key];
    sum.points += sign;
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      sum.offset[k] += sign * std::llround(kSteps_per_m * voxel_m_ * (at[axis] - corner[axis]));
    }
    sum.intensity += sign * intensityOf(point);
    if (sum.points == 0) sums_.erase(key);
  }
}

Cloud::Ptr PointMap::cloud() const {
  std::vector<std::pair<CellKey, const Sum*>> order;
  order.reserve(sums_.size());
  for (const auto& [key, sum] : sums_) order.emplace_back(key, &sum);
  std::sort(order.begin(), order.end());
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(order.size());
  for (const auto& [key, sum] : order) {
    const auto index = cellIndexOf(key);
    const double count = static_cast<double>(sum->points);
    Point point;
    for (std::size_t k = 0; k < 3; ++k) {
      point.data[k] = static_cast<float>(
          voxel_m_ * index[k] + static_cast<double>(sum->offset[k]) / (kSteps_per_m * count));
    }
    point.intensity = static_cast<float>(static_cast<double>(sum->intensity) / count) /
                      kIntensitySteps;
    cloud->push_back(point);
  }
  return cloud;
}

}  // namespace mrpt_sgraphs
