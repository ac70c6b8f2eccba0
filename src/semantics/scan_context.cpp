// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/scan_context.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

constexpr double kRadius_m = 24.0;
/// Walls and furniture, neither floor nor ceiling, relative to the sensor's height.
constexpr double kLowest_m = -0.3;
constexpr double kHighest_m = 1.2;

}  // namespace

ScanContext::ScanContext(const Cloud& cloud_base, const Eigen::Matrix3d& R_level_base) {
  occupied_.setZero();
  const Eigen::Vector3d origin = viewpointOf(cloud_base);
  for (const Point& point : cloud_base) {
    const Eigen::Vector3d p =
        R_level_base * (point.getVector3fMap().cast<double>() - origin);
    if (p.z() < kLowest_m || p.z() > kHighest_m) continue;
    const int ring = static_cast<int>(std::hypot(p.x(), p.y()) / kRadius_m * kRings);
    if (ring >= kRings) continue;
    const double turn = (std::atan2(p.y(), p.x()) + M_PI) / (2.0 * M_PI);
    occupied_(ring, std::min(kSectors - 1, static_cast<int>(turn * kSectors))) = 1.0F;
  }
  for (int sector = 0; sector < kSectors; ++sector) {
    const float length = occupied_.col(sector).norm();
    if (length > 0.0F) occupied_.col(sector) /= length;
  }
}

ScanContext::Comparison ScanContext::compare(const ScanContext& other) const {
  // sector s of the other is sector s + shift of this one
  Comparison best;
  for (int shift = 0; shift < kSectors; ++shift) {
    float sum = 0.0F;
    for (int sector = 0; sector < kSectors; ++sector) {
      sum += occupied_.col((sector + shift) % kSectors).dot(other.occupied_.col(sector));
    }
    const double similarity = static_cast<double>(sum) / kSectors;
    if (similarity > best.similarity) {
      best = {similarity, std::remainder(2.0 * M_PI * shift / kSectors, 2.0 * M_PI)};
    }
  }
  return best;
}

}  // namespace mrpt_sgraphs
