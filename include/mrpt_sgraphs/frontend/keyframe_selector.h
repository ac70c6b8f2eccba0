// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// When a scan becomes a keyframe: whatever comes first.
struct KeyframeConfig {
  double distance_m = 1.0;
  double angle_rad = 0.7;
  double time_s = 10.0;           ///< Only if the robot moved at all: standing still adds nothing.
  double still_distance_m = 0.1;  ///< Less than this is standing still.
  double voxel_size_m = 0.08;     ///< Edge of the voxel that keeps one point of a keyframe's cloud.
  double sigma_floor_m = 0.005;   ///< No motion between keyframes is known better than this,
  double sigma_floor_rad = 0.001;  ///< nor any turn better than this,
  double sigma_m_per_m = 0.004;   ///< and both grow with the distance:
  double sigma_rad_per_m = 0.0007;  ///< what a registration's Hessian does not know of.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("distance_m", self.distance_m, 0.05, 100.0);
    field("angle_rad", self.angle_rad, 0.05, 6.3);
    field("time_s", self.time_s, 0.1, 1e6);
    field("still_distance_m", self.still_distance_m, 0.0, 10.0);
    field("voxel_size_m", self.voxel_size_m, 0.01, 1.0);
    field("sigma_floor_m", self.sigma_floor_m, 1e-5, 1.0);
    field("sigma_floor_rad", self.sigma_floor_rad, 1e-6, 1.0);
    field("sigma_m_per_m", self.sigma_m_per_m, 0.0, 1.0);
    field("sigma_rad_per_m", self.sigma_rad_per_m, 0.0, 1.0);
  }
};

/// What odometry says of one scan.
struct ScanMotion {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();
  Matrix6 covariance = Matrix6::Zero();  ///< Of the motion since the last scan, right perturbation.

  template <typename Archive>
  void archive(Archive& a) {
    a("stamp_s", stamp_s);
    a("T_odom_base", T_odom_base);
    a("covariance", covariance);
  }
};

/// A scan that the graph keeps.
struct Keyframe {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();
  Matrix6 covariance = Matrix6::Identity();  ///< Of the motion since the last keyframe.
  Cloud::ConstPtr cloud;                     ///< Deskewed and thinned out, base frame.
  ObservedPlanesConstPtr planes;             ///< Not the selector's to fill in; may be null.
};

/// Picks the keyframes among the scans and adds up the uncertainty of the way between them.
class KeyframeSelector {
 public:
  explicit KeyframeSelector(const KeyframeConfig& config) : config_(config) {}

  /// @param deskewed  The scan's cloud in the base frame. The first keyframe waits for one that is.
  std::optional<Keyframe> process(const ScanMotion& scan, const Cloud& deskewed);

  void reset() { *this = KeyframeSelector(config_); }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("last_keyframe", last_keyframe_);
    a("last_T_odom_base", last_T_odom_base_);
    a("covariance_since", covariance_since_);
    a("distance_since_m", distance_since_m_);
  }

 private:
  bool isKeyframe(const ScanMotion& scan) const;
  Matrix6 withFloor(const Matrix6& covariance) const;

  KeyframeConfig config_;
  std::optional<ScanMotion> last_keyframe_;
  Pose last_T_odom_base_ = Pose::Identity();
  Matrix6 covariance_since_ = Matrix6::Zero();
  double distance_since_m_ = 0.0;
};

}  // namespace mrpt_sgraphs
