// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/motion_buffers.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/frontend/registration.h"

namespace mrpt_sgraphs {

/// A scan whose points were measured one after the other: when, and how a gyroscope says that the
/// robot turned meanwhile.
class Sweep {
 public:
  /// @param scan  Kept by reference; not empty.
  Sweep(const Cloud& scan, const ImuBuffer& imu);

  bool hasTimes() const { return to_s_ > from_s_; }
  bool hasTurning() const { return !R_stamp_base_.empty(); }
  double end_s() const;  ///< Stamp of the last point.

  /// About so many points at the most, spread over space so that near walls do not outvote far ones;
  /// turned to the stamp by the gyroscope where there is one.
  std::vector<ScanPoint> pointsToRegister(int most) const;

  /// The scan as if all of it had been measured at its stamp, with the given motion.
  Cloud::Ptr deskewed(const Tangent& velocity_base) const;

 private:
  ScanPoint scanPoint(const Point& point) const;

  const Cloud& scan_;
  double from_s_ = 0.0;
  double to_s_ = 0.0;
  double step_s_ = 0.0;
  std::vector<Eigen::Matrix3d> R_stamp_base_;  ///< At equal steps; empty without a gyroscope.
};

}  // namespace mrpt_sgraphs
