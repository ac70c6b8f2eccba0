// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/registration.h"

namespace mrpt_sgraphs {

/// Places scans in a map: a registration from the prediction, and where that does not do, a search
/// about it.
class ScanMatcher {
 public:
  explicit ScanMatcher(const RegistrationConfig& config) : config_(config) {}

  /// @param viewpoint_base  The sensor's place on the robot.
  RegistrationResult match(const std::vector<ScanPoint>& points, const VoxelMap& map,
                           const MotionPrior& prior, const Eigen::Vector3d& viewpoint_base);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("usual_inlier_ratio", usual_inlier_ratio_);
  }

 private:
  RegistrationConfig config_;
  double usual_inlier_ratio_ = 0.5;  ///< Running mean over the scans.
};

/// Whether the pose can be relied on: enough of the scan lies on the map, and most of what could.
bool isTrustworthy(const RegistrationResult& fit);

}  // namespace mrpt_sgraphs
