// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/sweep.h"

#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/frontend/thinning.h"

namespace mrpt_sgraphs {
namespace {

/// Times of a scan that all lie closer together than this say nothing of its motion.
constexpr double kShortSweep_s = 2e-3;
/// A millisecond each for a sweep of 0.1 s: the nearest one is near enough.
constexpr int kTurningSteps = 100;
/// Voxel edge that thins a scan for registration.
constexpr double kThinning_m = 0.15;

}  // namespace

Sweep::Sweep(const Cloud& scan, const ImuBuffer& imu) : scan_(scan) {
  const auto [first, last] =
      std::minmax_element(scan.begin(), scan.end(),
                          [](const Point& a, const Point& b) { return a.time < b.time; });
  if (last->time - first->time < kShortSweep_s) return;
  from_s_ = first->time;
  to_s_ = last->time;
  step_s_ = (to_s_ - from_s_) / kTurningSteps;
  for (int i = 0; i <= kTurningSteps; ++i) {
    const auto R = imu.rotation(stampOf(scan), stampOf(scan) + from_s_ + i * step_s_);
    if (!R) {
      R_stamp_base_.clear();
      return;
    }
    R_stamp_base_.push_back(*R);
  }
}

double Sweep::end_s() const { return stampOf(scan_) + to_s_; }

ScanPoint Sweep::scanPoint(const Point& point) const {
  ScanPoint result{point.getVector3fMap().cast<double>(), hasTimes() ? point.time : 0.0};
  if (hasTurning()) {
    const long step = std::lround((result.time_s - from_s_) / step_s_);
    const auto index = static_cast<std::size_t>(std::clamp<long>(step, 0, kTurningSteps));
    result.position = R_stamp_base_[index] * result.position;
  }
  return result;
}

std::vector<ScanPoint> Sweep::pointsToRegister(int most) const {
  const std::vector<int> kept = firstInVoxels(scan_, kThinning_m);
  const double stride = std::max(1.0, static_cast<double>(kept.size()) / most);
  std::vector<ScanPoint> points;
  for (double i = 0.0; i < static_cast<double>(kept.size()); i += stride) {
    points.push_back(scanPoint(scan_[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])]));
  }
  return points;
}

Cloud::Ptr Sweep::deskewed(const Tangent& velocity_base) const {
  Cloud::Ptr deskewed(new Cloud(scan_));
  if (!hasTimes()) return deskewed;
  for (Point& point : *deskewed) {
    point.getVector3fMap() = pointAtStamp(scanPoint(point), velocity_base).cast<float>();
    point.time = 0.0F;
  }
  return deskewed;
}

}  // namespace mrpt_sgraphs
