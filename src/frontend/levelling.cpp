// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/levelling.h"

#include <Eigen/Geometry>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr double kMaxTilt_rad = 0.52;  ///< A sensor may start tilted by 30 degrees.
constexpr double kSameGround_rad = 0.07;
constexpr double kSameGround_m = 0.10;
constexpr std::size_t kMinPlanes = 4;  ///< Fewer are a table or a step.

/// The mean normal of the planes that continue `seed`, and how many they are.
std::pair<Eigen::Vector3d, std::size_t> groundAround(const MapPlane& seed,
                                                     const std::vector<MapPlane>& planes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const MapPlane& plane : planes) {
    if (plane.normal.dot(seed.normal) < std::cos(kSameGround_rad)) continue;
    if (std::abs(seed.normal.dot(plane.centre - seed.centre)) > kSameGround_m) continue;
    sum += plane.normal;
    ++count;
  }
  return {sum.normalized(), count};
}

}  // namespace

Eigen::Matrix3d levelFromGround(const std::vector<MapPlane>& planes_base) {
  std::vector<MapPlane> candidates;
  for (const MapPlane& plane : planes_base) {
    if (plane.normal.z() > std::cos(kMaxTilt_rad) && plane.centre.z() < 0.0) {
      candidates.push_back(plane);
    }
  }
  std::pair<Eigen::Vector3d, std::size_t> best{Eigen::Vector3d::UnitZ(), 0};
  for (const MapPlane& seed : candidates) {
    const auto ground = groundAround(seed, candidates);
    if (ground.second > best.second) best = ground;
  }
  if (best.second < kMinPlanes) return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(best.first, Eigen::Vector3d::UnitZ())
      .toRotationMatrix();
}

}  // namespace mrpt_sgraphs
