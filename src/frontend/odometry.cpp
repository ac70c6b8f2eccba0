// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/odometry.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/frontend/levelling.h"
#include "mrpt_sgraphs/frontend/thinning.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"

namespace mrpt_sgraphs {
namespace {

/// The end of one sweep and the start of the next are known to fit this well.
constexpr double kSeam_m = 0.005;
constexpr double kSeam_rad = 0.003;
/// With a gyroscope the turning within a scan is known up to its bias and noise.
constexpr double kGyro_rad_s = 0.02;
constexpr double kGyroTurn_rad = 0.003;  ///< and that between two scans.
/// Odometry of wheels or legs takes a turn wrong by this share.
constexpr double kOdomTurnError = 0.1;
/// A robot that starts may already be moving.
constexpr double kFirstSpeed_m_s = 1.0;
constexpr double kFirstTurn_rad_s = 1.0;
/// Voxel edge that thins a scan for registration, so that near walls do not outvote far ones.
constexpr double kThinning_m = 0.15;
/// Times of a scan that all lie closer together than this say nothing of its motion.
constexpr double kShortSweep_s = 2e-3;
/// The local map forgets what is far whenever the robot has moved this far.
constexpr double kForgetEvery_m = 5.0;
/// Fewer points on their planes than this, and the pose is not to be trusted.
constexpr double kMinInlierRatio = 0.15;
/// A share of inliers that falls below this part of the usual one is no good fit.
constexpr double kSuspicious = 0.8;
/// A pose that is farther from its prediction than this (chi^2, 6 degrees of freedom) was not
/// predicted at all: it is looked for with a prediction that knows little.
constexpr double kMaxSurprise = 100.0;
constexpr double kLost_m = 1.0;
constexpr double kLost_rad = 0.5;
/// A scan that may be far from its prediction is tried with headings to both sides of it.
constexpr double kSearchStep_rad = 0.17;
constexpr double kMaxSearch_rad = 0.8;
constexpr std::size_t kSearchPoints = 600;
/// The distance at which an error in heading is weighed against one in position.
constexpr double kReach_m = 5.0;
/// Fewer of the points that have a plane lie on it than this, and the place is the wrong one.
constexpr double kMinConsistency = 0.5;
/// While lost the prediction slows down by this from scan to scan, so that it does not run away.
constexpr double kLostSlowdown = 0.7;
/// Scans that always go into the map: it starts empty.
constexpr int kFirstScans = 10;
/// Later ones only if the robot moved so far since the last that did: standing still would fill the
/// cells with one view.
constexpr double kMapEvery_m = 0.05;
constexpr double kMapEvery_rad = 0.02;

/// diag(sigma_m^2, sigma_rad^2)^-1
Matrix6 informationOf(double sigma_m, double sigma_rad) {
  Tangent information;
  information << Eigen::Vector3d::Constant(1.0 / (sigma_m * sigma_m)),
      Eigen::Vector3d::Constant(1.0 / (sigma_rad * sigma_rad));
  return information.asDiagonal();
}

struct MotionNoise {
  double acceleration;  ///< [m/s^2 or rad/s^2]
  double seam;          ///< [m or rad]
};

/// Adds to the covariance of (pose, velocity), at rows `at` and 6 + `at`, what a constant velocity
/// may be wrong by after dt_s. The velocity changes all the time; it is taken to change at once, so
/// that the pose is off by the change for the part that the last sweep did not see. (Were it taken to
/// change steadily, each displacement would set the velocity to twice its mean, and so swing.)
void addMotionNoise(const MotionNoise& noise, int at, double dt_s, double unseen_s,
                    Matrix12* covariance) {
  const double change = noise.acceleration * dt_s;
  const double drift = change * unseen_s;
  const double pose = noise.seam * noise.seam + drift * drift;
  const double cross = drift * change;
  for (int k = at; k < at + 3; ++k) {
    (*covariance)(k, k) += pose;
    (*covariance)(k, 6 + k) += cross;
    (*covariance)(6 + k, k) += cross;
    (*covariance)(6 + k, 6 + k) += change * change;
  }
}

/// Of the pose, whatever the velocity is.
Matrix6 covarianceOfPose(const Matrix12& information) {
  return information.ldlt().solve(Matrix12::Identity()).topLeftCorner<6, 6>();
}

/// The first and last time of the points [s]; {0, 0} where there are none worth the name.
std::pair<double, double> sweepOf(const Cloud& scan) {
  const auto [first, last] =
      std::minmax_element(scan.begin(), scan.end(),
                          [](const Point& a, const Point& b) { return a.time < b.time; });
  const double from_s = first->time;
  const double to_s = last->time;
  return to_s - from_s < kShortSweep_s ? std::make_pair(0.0, 0.0) : std::make_pair(from_s, to_s);
}

/// The gyroscope's turning over a sweep, R_stamp_base(tau), at equal steps between which one is near
/// enough.
class SweepTurning {
 public:
  /// Empty where the gyroscope has nothing to say.
  SweepTurning(const ImuBuffer& imu, double stamp_s, double from_s, double to_s) : from_s_(from_s) {
    if (to_s <= from_s) return;
    constexpr int kSteps = 100;
    step_s_ = (to_s - from_s) / kSteps;
    for (int i = 0; i <= kSteps; ++i) {
      const auto R = imu.rotation(stamp_s, stamp_s + from_s + i * step_s_);
      if (!R) {
        R_stamp_base_.clear();
        return;
      }
      R_stamp_base_.push_back(*R);
    }
  }

  bool known() const { return !R_stamp_base_.empty(); }

  Eigen::Vector3d apply(double time_s, const Eigen::Vector3d& p) const {
    if (!known()) return p;
    const auto last = static_cast<long>(R_stamp_base_.size()) - 1;
    const long step = std::clamp(std::lround((time_s - from_s_) / step_s_), 0L, last);
    return R_stamp_base_[static_cast<std::size_t>(step)] * p;
  }

 private:
  double from_s_;
  double step_s_ = 0.0;
  std::vector<Eigen::Matrix3d> R_stamp_base_;
};

std::vector<ScanPoint> pointsToRegister(const Cloud& scan, const SweepTurning& turning,
                                        bool has_times, int most) {
  const std::vector<int> kept = firstInVoxels(scan, kThinning_m);
  const double stride = std::max(1.0, static_cast<double>(kept.size()) / most);
  std::vector<ScanPoint> points;
  for (double i = 0.0; i < static_cast<double>(kept.size()); i += stride) {
    const Point& p = scan[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])];
    const double time_s = has_times ? p.time : 0.0;
    points.push_back({turning.apply(time_s, p.getVector3fMap().cast<double>()), time_s});
  }
  return points;
}

Cloud::Ptr deskew(const Cloud& scan, const SweepTurning& turning, const Tangent& velocity_base,
                  bool has_times) {
  Cloud::Ptr deskewed(new Cloud(scan));
  if (!has_times) return deskewed;
  for (Point& p : *deskewed) {
    const ScanPoint measured{turning.apply(p.time, p.getVector3fMap().cast<double>()), p.time};
    p.getVector3fMap() = pointAtStamp(measured, velocity_base).cast<float>();
  }
  return deskewed;
}

}  // namespace

Odometry::Odometry(const OdometryConfig& config) : config_(config), map_(config.map) {}

void Odometry::reset() { *this = Odometry(config_); }

MotionPrior Odometry::predict(double stamp_s, bool has_gyro) const {
  const double dt_s = stamp_s - last_->stamp_s;
  const double unseen_s = last_had_times_ ? std::max(0.0, stamp_s - last_sweep_end_s_) : dt_s;

  Pose T_last_now = Pose::Identity();
  T_last_now.translation() = dt_s * last_->velocity_base.head<3>();
  T_last_now.linear() = expSO3(dt_s * last_->velocity_base.tail<3>());
  const auto R_gyro = imu_.rotation(last_->stamp_s, stamp_s);
  if (R_gyro) T_last_now.linear() = *R_gyro;
  const Eigen::Matrix3d R_now_last = T_last_now.linear().transpose();

  MotionPrior prior;
  prior.mean.T_map_base = last_->T_odom_base * T_last_now;
  prior.mean.velocity_base << R_now_last * last_->velocity_base.head<3>(),
      last_->velocity_base.tail<3>();

  // the last covariance, carried along
  Matrix12 F = Matrix12::Zero();
  F.topLeftCorner<6, 6>() = adjointOfInverse(T_last_now);
  F.block<3, 3>(0, 6) = dt_s * R_now_last;
  F.block<3, 3>(3, 9) = (R_gyro ? 0.0 : dt_s) * Eigen::Matrix3d::Identity();
  F.block<3, 3>(6, 6) = R_now_last;
  F.block<3, 3>(9, 9).setIdentity();
  Matrix12 covariance = F * last_covariance_ * F.transpose();
  addMotionNoise({config_.max_acceleration_m_s2, kSeam_m}, 0, dt_s, unseen_s, &covariance);
  if (R_gyro) {
    const double sigma_rad = kGyroTurn_rad + kGyro_rad_s * dt_s;
    covariance.block<3, 3>(3, 3) += sigma_rad * sigma_rad * Eigen::Matrix3d::Identity();
  } else {
    addMotionNoise({config_.max_angular_acceleration_rad_s2, kSeam_rad}, 3, dt_s, unseen_s,
                   &covariance);
  }
  if (has_gyro) {  // what is estimated is the gyroscope's error, anew each scan
    prior.mean.velocity_base.tail<3>().setZero();
    covariance.bottomRows<3>().setZero();
    covariance.rightCols<3>().setZero();
    covariance.bottomRightCorner<3, 3>() = kGyro_rad_s * kGyro_rad_s * Eigen::Matrix3d::Identity();
  }
  prior.information = covariance.ldlt().solve(Matrix12::Identity());

  if (const auto T_odom = odom_in_.motion(last_->stamp_s, stamp_s)) fuseOdomIn(*T_odom, &prior);
  return prior;
}

void Odometry::fuseOdomIn(const Pose& T_last_now, MotionPrior* prior) const {
  const double turn_rad = logSO3(T_last_now.linear()).norm();
  const double way_m = T_last_now.translation().norm() + turn_rad;
  const Matrix6 information = informationOf(kSeam_m + config_.odom_in_sigma_m_per_m * way_m,
                                            kSeam_rad + config_.odom_in_sigma_rad_per_m * way_m +
                                                kOdomTurnError * turn_rad);
  const Tangent off =
      local(prior->mean.T_map_base, last_->T_odom_base * T_last_now);
  prior->information.topLeftCorner<6, 6>() += information;
  Eigen::Matrix<double, 12, 1> pull = Eigen::Matrix<double, 12, 1>::Zero();
  pull.head<6>() = information * off;
  const Eigen::Matrix<double, 12, 1> step = prior->information.ldlt().solve(pull);
  prior->mean.T_map_base = retract(prior->mean.T_map_base, step.head<6>());
  prior->mean.velocity_base += step.tail<6>();
}

MovingPose Odometry::bestStart(const std::vector<ScanPoint>& points, const MotionPrior& prior,
                               const Eigen::Vector3d& viewpoint_base) const {
  std::vector<ScanPoint> few;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSearchPoints);
  for (std::size_t i = 0; i < points.size(); i += stride) few.push_back(points[i]);

  const double sigma_rad = std::sqrt(covarianceOfPose(prior.information)(5, 5));
  const double reach_rad = std::min(2.0 * sigma_rad, kMaxSearch_rad);
  const int steps = static_cast<int>(std::ceil(reach_rad / kSearchStep_rad));
  MovingPose best = prior.mean;
  double best_ratio = 0.0;
  for (int step = -steps; step <= steps; ++step) {
    MovingPose turned = prior.mean;
    turned.T_map_base.linear() =
        prior.mean.T_map_base.linear() *
        Eigen::AngleAxisd(step * kSearchStep_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    // each on its own terms: a prior would favour the middle
    MotionPrior own = prior;
    own.mean = turned;
    const RegistrationResult fit = registerScan(few, map_, own, {turned, VoxelMap::kLevels - 1},
                                                viewpoint_base, config_.registration);
    if (fit.inlier_ratio > best_ratio) {
      best_ratio = fit.inlier_ratio;
      best = fit.estimate;
    }
  }
  return best;
}

RegistrationResult Odometry::placeScan(const std::vector<ScanPoint>& points,
                                       const MotionPrior& prior,
                                       const Eigen::Vector3d& viewpoint_base) {
  RegistrationResult best =
      registerScan(points, map_, prior, {prior.mean}, viewpoint_base, config_.registration);
  const auto search = [&](const MotionPrior& from) {
    const RegistrationResult fit =
        registerScan(points, map_, from, {bestStart(points, from, viewpoint_base)},
                     viewpoint_base, config_.registration);
    if (fit.inlier_ratio > best.inlier_ratio) best = fit;
  };
  const auto suspicious = [&] { return best.inlier_ratio < kSuspicious * usual_inlier_ratio_; };

  const Matrix6 covariance = covarianceOfPose(prior.information);
  const double reach_m =
      std::sqrt(covariance.topLeftCorner<3, 3>().diagonal().maxCoeff()) +
      kReach_m * std::sqrt(covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff());
  if (reach_m > config_.map.voxel_size_m || suspicious()) search(prior);

  const Tangent surprise = local(prior.mean.T_map_base, best.estimate.T_map_base);
  if (suspicious() || surprise.dot(covariance.ldlt().solve(surprise)) > kMaxSurprise) {
    // scans were lost, stamps lie, or the robot was pushed
    MotionPrior ignorant{prior.mean, Matrix12::Zero()};
    ignorant.information.topLeftCorner<6, 6>() = informationOf(kLost_m, kLost_rad);
    ignorant.information.bottomRightCorner<6, 6>() =
        informationOf(kFirstSpeed_m_s, kFirstTurn_rad_s);
    search(ignorant);
  }
  constexpr double kMemory = 0.9;
  usual_inlier_ratio_ = kMemory * usual_inlier_ratio_ + (1.0 - kMemory) * best.inlier_ratio;
  return best;
}

void Odometry::start(const Cloud& scan, OdometryResult* result) {
  const Eigen::Vector3d viewpoint = scan.sensor_origin_.head<3>().cast<double>();
  VoxelMap first(config_.map);
  for (const Point& p : scan) first.insert(p.getVector3fMap().cast<double>(), viewpoint);
  first.refit();
  constexpr double kLevelSpan_s = 1.0;
  const auto R_level = imu_.level(result->stamp_s - kLevelSpan_s, result->stamp_s + kLevelSpan_s);
  result->T_odom_base.linear() = R_level ? *R_level : levelFromGround(first.planes(1));
  result->covariance = informationOf(kSeam_m, kSeam_rad).inverse();
  last_covariance_.setZero();
  last_covariance_.topLeftCorner<6, 6>() = result->covariance;
  last_covariance_.bottomRightCorner<6, 6>() =
      informationOf(kFirstSpeed_m_s, kFirstTurn_rad_s).inverse();
  result->deskewed.reset(new Cloud(scan));
  result->registered = true;
  result->inlier_ratio = 1.0;
}

void Odometry::placeInMap(const Cloud& deskewed, const Pose& T_odom_base) {
  if (last_in_map_ && scans_in_map_ >= kFirstScans) {
    const Tangent motion = local(*last_in_map_, T_odom_base);
    if (motion.head<3>().norm() < kMapEvery_m && motion.tail<3>().norm() < kMapEvery_rad) return;
  }
  const Eigen::Vector3d last_place = (last_in_map_ ? *last_in_map_ : T_odom_base).translation();
  last_in_map_ = T_odom_base;
  ++scans_in_map_;

  way_m_ += (T_odom_base.translation() - last_place).norm();
  const Eigen::Vector3d viewpoint =
      T_odom_base * Eigen::Vector3d(deskewed.sensor_origin_.head<3>().cast<double>());
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

std::optional<OdometryResult> Odometry::process(const Cloud& scan) {
  OdometryResult result;
  result.stamp_s = stampOf(scan);
  if (scan.empty() || (last_ && result.stamp_s <= last_->stamp_s)) return std::nullopt;

  CpuStopwatch watch;
  const auto [from_s, to_s] = sweepOf(scan);
  const bool has_times = to_s > from_s;
  if (!last_) {
    start(scan, &result);
    result.register_ms = watch.lap();
  } else {
    const double dt_s = result.stamp_s - last_->stamp_s;
    const SweepTurning turning(imu_, result.stamp_s, from_s, to_s);
    MotionPrior prior = predict(result.stamp_s, turning.known());
    if (dt_s > config_.max_gap_s) {
      result.problem = "no scan for " + std::to_string(dt_s) + " s";
    }
    const std::vector<ScanPoint> points =
        pointsToRegister(scan, turning, has_times, config_.registration_points);
    result.deskew_ms = watch.lap();
    const Eigen::Vector3d viewpoint = scan.sensor_origin_.head<3>().cast<double>();
    const RegistrationResult fit = placeScan(points, prior, viewpoint);
    result.register_ms = watch.lap();

    result.registered = fit.matched > 0 && fit.inlier_ratio >= kMinInlierRatio &&
                        fit.consistency >= kMinConsistency;
    const MovingPose& pose = result.registered ? fit.estimate : prior.mean;
    result.T_odom_base = pose.T_map_base;
    result.velocity_base = (result.registered ? 1.0 : kLostSlowdown) * pose.velocity_base;
    result.degenerate_directions = result.registered ? fit.degenerate_directions : 6;
    result.inlier_ratio = fit.inlier_ratio;
    result.iterations = fit.iterations;
    last_covariance_ = (result.registered ? fit.posterior_information : prior.information)
                           .ldlt()
                           .solve(Matrix12::Identity());
    result.covariance = last_covariance_.topLeftCorner<6, 6>();
    if (!result.registered && result.problem.empty()) {
      result.problem = "only " + std::to_string(fit.matched) + " of " +
                       std::to_string(points.size()) + " points lie on the local map";
    }
    result.deskewed = deskew(scan, turning, result.velocity_base, has_times);
    if (turning.known()) {
      imu_.correctBias(-result.velocity_base.tail<3>());
      const Pose T_last_now = last_->T_odom_base.inverse() * result.T_odom_base;
      result.velocity_base.tail<3>() = logSO3(T_last_now.linear()) / dt_s;
    }
    result.deskew_ms += watch.lap();
  }

  if (result.registered) placeInMap(*result.deskewed, result.T_odom_base);
  result.map_ms = watch.lap();

  last_ = result;
  last_->deskewed.reset();
  last_sweep_end_s_ = result.stamp_s + to_s;
  last_had_times_ = has_times;
  return result;
}

}  // namespace mrpt_sgraphs
