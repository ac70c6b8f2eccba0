// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/motion_buffers.h"
#include "mrpt_sgraphs/frontend/motion_model.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/frontend/registration.h"
#include "mrpt_sgraphs/frontend/scan_matcher.h"
#include "mrpt_sgraphs/frontend/voxel_map.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// How a scan is placed. The defaults suit 16 to 128 beams carried by a walking robot indoors.
struct OdometryConfig {
  MotionModelConfig motion;
  VoxelMapConfig map;
  RegistrationConfig registration;
  double local_map_radius_m = 60.0;          ///< What is farther from the robot is forgotten,
  /// and what was last seen so long a way ago: coming back to it is a loop for the graph to close,
  /// not a jump for the odometry to make.
  double local_map_way_m = 30.0;
  int registration_points = 2500;            ///< Points of a scan that are registered.
  int map_points = 12000;                    ///< Points of a scan that go into the local map.
  double max_gap_s = 3.0;                    ///< A longer pause tells nothing of the motion in it.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    MotionModelConfig::fields(self.motion, field);
    VoxelMapConfig::fields(self.map, field);
    RegistrationConfig::fields(self.registration, field);
    field("local_map_radius_m", self.local_map_radius_m, 5.0, 1000.0);
    field("local_map_way_m", self.local_map_way_m, 1.0, 1e6);
    field("registration_points", self.registration_points, 100, 100000);
    field("map_points", self.map_points, 100, 1000000);
    field("max_gap_s", self.max_gap_s, 0.1, 100.0);
  }
};

/// Where a scan was taken, in the odometry's own frame.
struct OdometryResult {
  double stamp_s = 0.0;
  Pose T_odom_base = Pose::Identity();  ///< At the header stamp.
  Tangent velocity_base = Tangent::Zero();  ///< [m/s, rad/s] during the scan.
  /// Of the motion since the last scan (right perturbation of T_odom_base, `[t; theta]`).
  Matrix6 covariance = Matrix6::Identity();
  /// The scan as if it had been taken at its stamp; base frame. The first one has kept its times: it is
  /// not known yet how the robot moved.
  Cloud::Ptr deskewed;
  bool registered = false;   ///< False: the pose is a prediction only.
  int degenerate_directions = 0;  ///< Directions that were left to the prediction.
  double inlier_ratio = 0.0;
  int iterations = 0;
  double deskew_ms = 0.0;    ///< CPU
  double register_ms = 0.0;  ///< CPU
  double map_ms = 0.0;       ///< CPU
  std::string problem;       ///< Why the pose is not to be trusted; empty if it is.
};

/// LiDAR odometry: each scan is deskewed by its own motion and registered to a local map of planes.
///
/// Pose and velocity at the scan's stamp are estimated together (12 unknowns): a point measured at
/// time tau sits at T exp(tau v) p, so a sweep that a gait distorts is straightened by what it shows
/// itself. The last estimate with its covariance predicts the next as a Kalman filter does, with a
/// noise that follows from the largest acceleration: what one scan does not show of pose or velocity
/// the sequence does, and directions that no point constrains stay with the prediction. An IMU
/// supplies the turning within the scan where there is one, `odom_in` the motion between scans. The
/// robot may move from the first scan on: the second one tells how the first was distorted.
class Odometry {
 public:
  explicit Odometry(const OdometryConfig& config);

  void addImu(const ImuSample& sample) { imu_.add(sample); }
  void addOdom(const OdomSample& sample) { odom_in_.add(sample); }

  /// @return Nothing for a scan that is not newer than the last one.
  std::optional<OdometryResult> process(const Cloud& scan);

  /// After a jump in time (a bag that starts again): forgets everything but the parameters.
  void reset();

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("map", map_);
    a("matcher", matcher_);
    a("imu", imu_);
    a("odom_in", odom_in_);
    a("last", last_);
    a("first", first_);
    a("last_in_map", last_in_map_);
    a("scans_in_map", scans_in_map_);
    a("way_m", way_m_);
    a("forgot_at_m", forgot_at_m_);
  }

 private:
  OdometryResult start(const Cloud& scan);
  void findFirstMotion(const Cloud& scan);
  OdometryResult follow(const Cloud& scan);
  void placeInMap(const Cloud& deskewed, const Pose& T_odom_base);

  OdometryConfig config_;
  VoxelMap map_;
  ScanMatcher matcher_;
  ImuBuffer imu_;
  OdomBuffer odom_in_;
  std::optional<MotionState> last_;  ///< Nothing before the first scan.
  Cloud::ConstPtr first_;            ///< Until the second scan tells how it was distorted.
  std::optional<Pose> last_in_map_;  ///< T_odom_base of the last scan that went into the map.
  int scans_in_map_ = 0;
  double way_m_ = 0.0;        ///< Covered so far.
  double forgot_at_m_ = 0.0;  ///< When the map last forgot.
};

}  // namespace mrpt_sgraphs
