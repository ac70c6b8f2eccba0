// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/localization.h"

#include <Eigen/Cholesky>
#include <stdexcept>
#include <utility>

#include "mrpt_sgraphs/semantics/known_surroundings.h"
#include "mrpt_sgraphs/slam/graph_slam.h"

namespace mrpt_sgraphs {
namespace {

/// The session is found by its clouds, and each search is to see the same on every machine.
BackEndConfig forSession(BackEndConfig config) {
  config.hierarchy.cloud_spacing_m = 0.0;
  config.hierarchy.budget_ms = 0.0;
  return config;
}

/// Directions that no point tells of are known this badly [m^2, rad^2].
constexpr double kUnknown = 100.0;

Matrix6 inverse(const Matrix6& matrix) { return matrix.ldlt().solve(Matrix6::Identity()); }

}  // namespace

/// The map around a place, as long as the robot is near it.
struct Localization::Surroundings {
  Eigen::Vector3d place_map;
  VoxelMap voxels;
};

Localization::Localization(GraphSnapshotConstPtr map, const BackEndConfig& config)
    : map_(std::move(map)), config_(forSession(config)), relocator_(map_, config_.relocation) {
  becomeLost("nothing was seen yet");
}

Localization::~Localization() = default;

void Localization::requireUsable(const Keyframe& keyframe) const {
  if (keyframe.cloud == nullptr || keyframe.cloud->empty()) {
    throw std::invalid_argument("a keyframe needs a cloud");
  }
  if (recent_.empty()) return;
  if (keyframe.stamp_s <= recent_.back().stamp_s) {
    throw std::invalid_argument("a keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s is not newer than the last one of " +
                                std::to_string(recent_.back().stamp_s) + " s");
  }
  if (!keyframe.covariance.allFinite() || keyframe.covariance.llt().info() != Eigen::Success) {
    throw std::invalid_argument("the covariance of a keyframe is not positive definite");
  }
}

const LocalizationStatus& Localization::addKeyframe(const Keyframe& keyframe) {
  requireUsable(keyframe);
  if (status_.localized) follow(keyframe);
  recent_.push_back(keyframe);
  const auto most = static_cast<std::size_t>(config_.localization.max_session_keyframes) / 2;
  while (recent_.size() > most) recent_.pop_front();
  if (!status_.localized) search(keyframe);
  return status_;
}

std::optional<Pose> Localization::T_map_odom() const {
  return status_.localized ? std::optional<Pose>(T_map_odom_) : std::nullopt;
}

const VoxelMap& Localization::surroundings(const Eigen::Vector3d& place_map) {
  if (surroundings_ == nullptr || (surroundings_->place_map - place_map).norm() >
                                      config_.localization.submap_move_m) {
    surroundings_ = std::make_unique<Surroundings>(Surroundings{
        place_map, surroundingsOf(*map_, place_map, config_.relocation.surroundings)});
  }
  return surroundings_->voxels;
}

/// Empty if it fits.
std::string Localization::misfitOf(const RegistrationResult& fit) const {
  const LocalizationConfig& gate = config_.localization;
  if (fit.converged && fit.inlier_ratio >= gate.min_inlier_ratio &&
      fit.consistency >= gate.min_consistency) {
    return {};
  }
  return "of the last keyframe " + std::to_string(static_cast<int>(100.0 * fit.inlier_ratio)) +
         " % of the points lie on the map, " +
         std::to_string(static_cast<int>(100.0 * fit.consistency)) + " % of those that could";
}

void Localization::follow(const Keyframe& keyframe) {
  const Keyframe& last = recent_.back();
  const Pose T_last_now = last.T_odom_base.inverse() * keyframe.T_odom_base;
  const Matrix6 adjoint = adjointOfInverse(T_last_now);
  covariance_ = adjoint * covariance_ * adjoint.transpose() + keyframe.covariance;
  status_.way_since_fit_m += T_last_now.translation().norm();

  MotionPrior prior;
  prior.mean.T_map_base = T_map_odom_ * keyframe.T_odom_base;
  // a direction that the points leave open stays with the prediction
  prior.information = 1e-2 * Matrix12::Identity();
  const Eigen::Vector3d viewpoint = viewpointOf(*keyframe.cloud);
  const RegistrationResult fit = registerScan(
      registrationPoints(*keyframe.cloud), surroundings(prior.mean.T_map_base * viewpoint), prior,
      {prior.mean, 1}, viewpoint, config_.relocation.registration);
  status_.inlier_ratio = fit.inlier_ratio;
  status_.rms_m = fit.rms_m;
  status_.problem = misfitOf(fit);
  if (status_.problem.empty()) correct(keyframe, fit);
  if (status_.way_since_fit_m > config_.localization.lost_after_m) {
    becomeLost("lost: nothing has fitted for " + std::to_string(status_.way_since_fit_m) + " m; " +
               status_.problem);
  }
}

/// The Kalman update with what the points say of the pose.
void Localization::correct(const Keyframe& keyframe, const RegistrationResult& fit) {
  const Pose T_map_base = T_map_odom_ * keyframe.T_odom_base;
  const RelocationConfig& known = config_.relocation;
  Tangent floor;
  floor << Eigen::Vector3d::Constant(known.sigma_floor_m * known.sigma_floor_m),
      Eigen::Vector3d::Constant(known.sigma_floor_rad * known.sigma_floor_rad);
  const Matrix6 measured =
      inverse(fit.information + Matrix6::Identity() / kUnknown) + Matrix6(floor.asDiagonal());
  const Tangent surprise = local(T_map_base, fit.estimate.T_map_base);
  const Matrix6 sum = covariance_ + measured;
  const double chi2 = surprise.dot(sum.ldlt().solve(surprise));
  if (chi2 > config_.localization.max_chi2) {
    status_.problem = "the last keyframe fits " + std::to_string(surprise.head<3>().norm()) +
                      " m from where it was expected";
    return;
  }
  const Matrix6 gain = covariance_ * inverse(sum);
  const Pose corrected = orthonormalized(retract(T_map_base, gain * surprise));
  covariance_ = ((Matrix6::Identity() - gain) * covariance_).eval();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  T_map_odom_ = orthonormalized(corrected * keyframe.T_odom_base.inverse());
  status_.way_since_fit_m = 0.0;
}

void Localization::becomeLost(const std::string& problem) {
  status_.localized = false;
  status_.problem = problem;
  surroundings_.reset();
  session_ = std::make_unique<GraphSlam>(config_);
}

void Localization::addToSession(const Keyframe& keyframe) {
  const auto most = static_cast<std::size_t>(config_.localization.max_session_keyframes);
  if (session_->snapshot()->keyframes.size() >= most) {
    session_ = std::make_unique<GraphSlam>(config_);
    for (const Keyframe& known : recent_) session_->addKeyframe(known);
  } else {
    session_->addKeyframe(keyframe);
  }
  if (!config_.floors.enabled) return;
  session_->setFloors(detectFloors(*session_->snapshot(), config_.floors));
}

void Localization::search(const Keyframe& keyframe) {
  addToSession(keyframe);
  if (const auto pointed_at = std::exchange(T_map_base_pointed_at_, std::nullopt)) {
    if (guess(*pointed_at)) return;
  }
  const GraphSnapshotConstPtr session = session_->snapshot();
  const RelocationSearch search = relocator_.find(*session);
  status_.problem = search.undecided;
  if (!search.found) return;
  localizeAt(search.found->T_map_session * session->keyframes.back().T_map_base,
             search.found->information);
}

void Localization::localizeAt(const Pose& T_map_base, const Matrix6& information) {
  T_map_odom_ = orthonormalized(T_map_base * recent_.back().T_odom_base.inverse());
  covariance_ = inverse(information);
  status_.localized = true;
  status_.problem.clear();
  status_.way_since_fit_m = 0.0;
  ++status_.relocations;
  session_.reset();
  surroundings_.reset();
}

bool Localization::setInitialPose(const Pose& T_map_base) {
  if (!recent_.empty()) return guess(T_map_base);
  T_map_base_pointed_at_ = T_map_base;
  return true;
}

/// By what the newest keyframe alone has seen: of those before it, it may just have been told that
/// they are somewhere else.
bool Localization::guess(const Pose& T_map_base) {
  GraphSlam moment(config_);
  moment.addKeyframe(recent_.back());
  const GraphSnapshotConstPtr session = moment.snapshot();
  const Pose T_session_base = session->keyframes.back().T_map_base;
  const RelocationSearch search =
      relocator_.findNear(*session, T_map_base * T_session_base.inverse());
  if (!search.found) {
    status_.problem = "not there where it was pointed at: " + search.undecided;
    return false;
  }
  localizeAt(search.found->T_map_session * T_session_base, search.found->information);
  return true;
}

}  // namespace mrpt_sgraphs
