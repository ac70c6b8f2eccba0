// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/odometry.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mrpt_sgraphs/frontend/levelling.h"
#include "mrpt_sgraphs/frontend/sweep.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"

namespace mrpt_sgraphs {
namespace {

/// Gravity is averaged over so long before and after the first scan.
constexpr double kLevelSpan_s = 1.0;
/// While lost the prediction slows down by this from scan to scan, so that it does not run away.
constexpr double kLostSlowdown = 0.7;
/// Scans that always go into the map: it starts empty.
constexpr int kFirstScans = 10;
/// Later ones only if the robot moved so far since the last that did: standing still would fill the
/// cells with one view.
constexpr double kMapEvery_m = 0.05;
constexpr double kMapEvery_rad = 0.02;
/// The local map forgets whenever the robot has gone this far.
constexpr double kForgetEvery_m = 5.0;

/// R_level_base of a first scan, without an IMU.
Eigen::Matrix3d levelByGround(const Cloud& scan, const VoxelMapConfig& config) {
  VoxelMap map(config);
  for (const Point& p : scan) map.insert(p.getVector3fMap().cast<double>(), viewpointOf(scan));
  map.refit();
  constexpr int kLevel = 1;  // the ground's rings lie too far apart for the finest cells
  return levelFromGround(map.planes(kLevel));
}

}  // namespace

Odometry::Odometry(const OdometryConfig& config)
    : config_(config), map_(config.map), matcher_(config.registration) {}

void Odometry::reset() { *this = Odometry(config_); }

std::optional<OdometryResult> Odometry::process(const Cloud& scan) {
  if (scan.empty() || (last_ && stampOf(scan) <= last_->stamp_s)) return std::nullopt;
  if (first_ != nullptr) findFirstMotion(scan);
  OdometryResult result = last_ ? follow(scan) : start(scan);
  CpuStopwatch watch;
  if (result.registered) placeInMap(*result.deskewed, result.T_odom_base);
  result.map_ms = watch.lap();
  return result;
}

OdometryResult Odometry::start(const Cloud& scan) {
  CpuStopwatch watch;
  OdometryResult result;
  result.stamp_s = stampOf(scan);
  const auto R_level = imu_.level(result.stamp_s - kLevelSpan_s, result.stamp_s + kLevelSpan_s);
  result.T_odom_base.linear() = R_level ? *R_level : levelByGround(scan, config_.map);
  result.deskewed.reset(new Cloud(scan));
  result.inlier_ratio = 1.0;

  result.registered = true;
  const Sweep sweep(scan, imu_);
  if (sweep.hasTimes()) first_ = result.deskewed;
  last_ = startingMotion(result.stamp_s, result.T_odom_base);
  last_->seen_until_s = sweep.end_s();
  result.covariance = last_->covariance.topLeftCorner<6, 6>();
  result.register_ms = watch.lap();
  return result;
}

/// The first scan went into the map as it came. Where the second lies in it tells the motion in between
/// and so how the first was distorted; straightened by that, it tells the motion better.
void Odometry::findFirstMotion(const Cloud& scan) {
  const Cloud::ConstPtr first = std::exchange(first_, nullptr);
  const MotionState start = *last_;
  const double dt_s = stampOf(scan) - start.stamp_s;
  if (dt_s > config_.max_gap_s) return;
  const Sweep first_sweep(*first, imu_);
  const Sweep sweep(scan, imu_);
  const std::vector<ScanPoint> points = sweep.pointsToRegister(config_.registration_points);
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    const MotionPrior prior = predictMotion(*last_, stampOf(scan), sweep.hasTurning(), imu_,
                                            odom_in_, config_.motion);
    ScanMatcher matcher = matcher_;
    const RegistrationResult fit = matcher.match(points, map_, prior, viewpointOf(scan));
    if (fit.matched == 0) break;
    Tangent velocity_base = local(start.mean.T_map_base, fit.estimate.T_map_base) / dt_s;
    Tangent straightening = velocity_base;
    if (first_sweep.hasTurning()) straightening.tail<3>().setZero();  // the gyroscope has done it
    const Tangent change = velocity_base - last_->mean.velocity_base;
    last_ = start;  // as uncertain as before
    last_->mean.velocity_base = velocity_base;
    map_ = VoxelMap(config_.map);
    last_in_map_.reset();
    scans_in_map_ = 0;
    placeInMap(*first_sweep.deskewed(straightening), start.mean.T_map_base);
    constexpr double kSmall = 0.01;  // a millimetre in a sweep
    if (change.norm() < kSmall) break;
  }
}

OdometryResult Odometry::follow(const Cloud& scan) {
  CpuStopwatch watch;
  OdometryResult result;
  result.stamp_s = stampOf(scan);
  const double dt_s = result.stamp_s - last_->stamp_s;
  if (dt_s > config_.max_gap_s) result.problem = "no scan for " + std::to_string(dt_s) + " s";

  const Sweep sweep(scan, imu_);
  const MotionPrior prior = predictMotion(*last_, result.stamp_s, sweep.hasTurning(), imu_,
                                          odom_in_, config_.motion);
  const std::vector<ScanPoint> points = sweep.pointsToRegister(config_.registration_points);
  result.deskew_ms = watch.lap();
  const RegistrationResult fit = matcher_.match(points, map_, prior, viewpointOf(scan));
  result.register_ms = watch.lap();

  result.registered = isTrustworthy(fit);
  result.inlier_ratio = fit.inlier_ratio;
  result.iterations = fit.iterations;
  MovingPose pose = fit.estimate;
  Matrix12 information = fit.posterior_information;
  result.degenerate_directions = fit.degenerate_directions;
  if (!result.registered) {
    pose = prior.mean;
    information = prior.information;
    result.degenerate_directions = 6;
    if (result.problem.empty()) {
      result.problem = "only " + std::to_string(fit.matched) + " of " +
                       std::to_string(points.size()) + " points lie on the local map";
    }
  }
  result.T_odom_base = pose.T_map_base;
  result.deskewed = sweep.deskewed(pose.velocity_base);
  if (sweep.hasTurning()) {  // what the gyroscope had wrong was estimated, not the turning
    imu_.correctBias(-pose.velocity_base.tail<3>());
    const Eigen::Matrix3d R_last_now =
        last_->mean.T_map_base.linear().transpose() * pose.T_map_base.linear();
    pose.velocity_base.tail<3>() = logSO3(R_last_now) / dt_s;
  }
  if (!result.registered) pose.velocity_base *= kLostSlowdown;
  result.velocity_base = pose.velocity_base;

  last_ = MotionState{result.stamp_s, sweep.end_s(), pose,
                      information.ldlt().solve(Matrix12::Identity())};
  result.covariance = last_->covariance.topLeftCorner<6, 6>();
  result.deskew_ms += watch.lap();
  return result;
}

void Odometry::placeInMap(const Cloud& deskewed, const Pose& T_odom_base) {
  const Pose last = last_in_map_ ? *last_in_map_ : T_odom_base;
  const Tangent motion = local(last, T_odom_base);
  if (scans_in_map_ >= kFirstScans && motion.head<3>().norm() < kMapEvery_m &&
      motion.tail<3>().norm() < kMapEvery_rad) {
    return;
  }
  last_in_map_ = T_odom_base;
  ++scans_in_map_;
  way_m_ += motion.head<3>().norm();

  const Eigen::Vector3d viewpoint = T_odom_base * viewpointOf(deskewed);
  const double stride = std::max(1.0, static_cast<double>(deskewed.size()) / config_.map_points);
  for (double i = 0.0; i < static_cast<double>(deskewed.size()); i += stride) {
    const Point& p = deskewed[static_cast<std::size_t>(i)];
    map_.insert(T_odom_base * Eigen::Vector3d(p.getVector3fMap().cast<double>()), viewpoint,
                way_m_);
  }
  map_.refit();
  if (way_m_ - forgot_at_m_ > kForgetEvery_m) {
    map_.forget(T_odom_base.translation(), config_.local_map_radius_m,
                way_m_ - config_.local_map_way_m);
    forgot_at_m_ = way_m_;
  }
}

}  // namespace mrpt_sgraphs
