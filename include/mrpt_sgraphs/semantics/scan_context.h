// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

#include "mrpt_sgraphs/geometry/point_cloud.h"

namespace mrpt_sgraphs {

/// A place as seen from above, in rings and sectors about the sensor, after Kim and Kim, *Scan
/// Context* (IROS 2018). Theirs keeps the greatest height of each bin, which indoors is the ceiling
/// everywhere; ours keeps whether anything stands at the height of the sensor.
class ScanContext {
 public:
  static constexpr int kRings = 24;
  static constexpr int kSectors = 72;

  ScanContext() = default;

  /// @param R_level_base  Makes the cloud horizontal.
  ScanContext(const Cloud& cloud_base, const Eigen::Matrix3d& R_level_base);

  struct Comparison {
    double similarity = 0.0;  ///< 0 to 1, at the best rotation
    double yaw_rad = 0.0;     ///< of that rotation: R_this_other about the vertical
  };
  Comparison compare(const ScanContext& other) const;

  template <typename Archive>
  void archive(Archive& a) {
    a.raw(occupied_.data(), static_cast<std::size_t>(occupied_.size()) * sizeof(float));
  }

 private:
  Eigen::Matrix<float, kRings, kSectors> occupied_;  ///< a column a sector, unit length or zero
};

}  // namespace mrpt_sgraphs
