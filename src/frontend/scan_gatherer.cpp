// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/scan_gatherer.h"

#include <algorithm>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

/// A scan from where the last one was shows nothing that is new.
constexpr double kNewPlace_m = 0.04;
constexpr double kNewPlace_rad = 0.04;
/// Of more than these every second is forgotten: a robot may turn on the spot for long.
constexpr std::size_t kMaxScans = 64;

void append(const Cloud& scan, const Pose& T_target_base, GatheredPoints* gathered) {
  gathered->views.push_back({gathered->cloud.size(), T_target_base * viewpointOf(scan)});
  const Eigen::Matrix3f R = T_target_base.linear().cast<float>();
  const Eigen::Vector3f t = T_target_base.translation().cast<float>();
  for (const Point& p : scan) {
    gathered->cloud.push_back(p);
    gathered->cloud.back().getVector3fMap() = R * p.getVector3fMap() + t;
  }
}

}  // namespace

GatheredPoints gatheredFrom(const Cloud& scan) {
  GatheredPoints gathered;
  gathered.cloud = scan;
  gathered.views.push_back({0, viewpointOf(scan)});
  return gathered;
}

void ScanGatherer::add(const Cloud::ConstPtr& deskewed, const Pose& T_odom_base) {
  if (scans_.size() > 1) {
    const Tangent motion = local(scans_[scans_.size() - 2].T_odom_base, scans_.back().T_odom_base);
    const bool stood_still =
        motion.head<3>().norm() < kNewPlace_m && motion.tail<3>().norm() < kNewPlace_rad;
    if (stood_still) scans_.pop_back();
  }
  if (scans_.size() >= kMaxScans) {
    for (std::size_t k = 0; 2 * k < scans_.size(); ++k) scans_[k] = scans_[2 * k];
    scans_.resize((scans_.size() + 1) / 2);
  }
  scans_.push_back({deskewed, T_odom_base});
}

GatheredPoints ScanGatherer::take() {
  if (scans_.empty()) throw std::logic_error("no scan was added since the last were taken");
  const Pose T_base_odom = scans_.back().T_odom_base.inverse();
  std::size_t points = 0;
  for (const Scan& scan : scans_) points += scan.cloud->size();

  // so many as are wanted, evenly along the way, the newest among them
  const std::size_t mean_points = std::max<std::size_t>(1, points / scans_.size());
  const std::size_t wanted = (wanted_points_ + mean_points - 1) / mean_points;
  const std::size_t taken = std::clamp<std::size_t>(wanted, 1, scans_.size());
  GatheredPoints gathered;
  gathered.cloud.reserve(mean_points * (taken + 1));
  for (std::size_t k = 0; k < taken; ++k) {
    const Scan& scan = scans_[(k + 1) * scans_.size() / taken - 1];
    append(*scan.cloud, T_base_odom * scan.T_odom_base, &gathered);
  }
  gathered.cloud.header = scans_.back().cloud->header;
  gathered.cloud.sensor_origin_ = scans_.back().cloud->sensor_origin_;
  scans_.clear();
  return gathered;
}

}  // namespace mrpt_sgraphs
