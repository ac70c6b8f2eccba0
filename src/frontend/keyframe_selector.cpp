// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/keyframe_selector.h"

#include "mrpt_sgraphs/frontend/thinning.h"

namespace mrpt_sgraphs {

bool KeyframeSelector::isKeyframe(const ScanMotion& scan) const {
  if (!last_keyframe_) return true;
  const Tangent motion = local(last_keyframe_->T_odom_base, scan.T_odom_base);
  const double distance_m = motion.head<3>().norm();
  const bool late = scan.stamp_s - last_keyframe_->stamp_s >= config_.time_s;
  return distance_m >= config_.distance_m || motion.tail<3>().norm() >= config_.angle_rad ||
         (late && distance_m >= config_.still_distance_m);
}

Matrix6 KeyframeSelector::withFloor(const Matrix6& covariance) const {
  const double sigma_m = config_.sigma_floor_m + config_.sigma_m_per_m * distance_since_m_;
  const double sigma_rad = config_.sigma_floor_rad + config_.sigma_rad_per_m * distance_since_m_;
  Tangent variance;
  variance << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return covariance + Matrix6(variance.asDiagonal());
}

std::optional<Keyframe> KeyframeSelector::process(const ScanMotion& scan, const Cloud& deskewed) {
  if (!last_keyframe_ && !isOfOneMoment(deskewed)) return std::nullopt;
  if (last_keyframe_) {
    const Pose T_last_now = last_T_odom_base_.inverse() * scan.T_odom_base;
    const Matrix6 adjoint = adjointOfInverse(T_last_now);
    covariance_since_ = adjoint * covariance_since_ * adjoint.transpose() + scan.covariance;
    distance_since_m_ += T_last_now.translation().norm();
  }
  last_T_odom_base_ = scan.T_odom_base;
  if (!isKeyframe(scan)) return std::nullopt;

  Keyframe keyframe;
  keyframe.stamp_s = scan.stamp_s;
  keyframe.T_odom_base = scan.T_odom_base;
  keyframe.covariance = withFloor(covariance_since_);
  keyframe.cloud = thinned(deskewed, config_.voxel_size_m);

  last_keyframe_ = scan;
  covariance_since_.setZero();
  distance_since_m_ = 0.0;
  return keyframe;
}

}  // namespace mrpt_sgraphs
