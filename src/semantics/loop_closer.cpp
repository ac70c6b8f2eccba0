// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/loop_closer.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/geometry/archive.h"
#include "mrpt_sgraphs/graph/uncertainty.h"
#include "mrpt_sgraphs/semantics/known_surroundings.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kRadiusSigmas = 3.0;
constexpr double kClimbSigmas = 3.0;
/// Covariances that are added up know nothing of systematic errors: gates are opened by this factor.
constexpr double kGateInflation = 4.0;
/// Places that look less alike than this from above are not tried for their looks.
constexpr double kMinSimilarity = 0.45;

Eigen::Matrix3d levelRotation(const KeyframeNode& keyframe) {
  // the odometry frame is level: what is left of the keyframe's rotation when its yaw is taken out
  const Eigen::Matrix3d R = keyframe.T_odom_base.linear();
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  return Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R;
}

/// The grounds of the levels, for what the newest keyframe has seen before.
class Levels {
 public:
  Levels(const GraphSnapshot& graph, double max_step_m) : graph_(graph), max_step_m_(max_step_m) {}

  /// Two nodes may be one level that drift has torn apart, or wings with a step between them: a
  /// loop within one of those is none between storeys.
  bool areTwoStoreys(const KeyframeNode& a, const KeyframeNode& b) const {
    if (!a.floor || !b.floor || *a.floor == *b.floor) return false;
    const FloorNode* one = find(*a.floor);
    const FloorNode* other = find(*b.floor);
    if (one == nullptr || other == nullptr) return true;
    const Eigen::Vector3d place = b.T_map_base.translation();
    const double step_m = (one->ground_map.normal.dot(place) - one->ground_map.distance) -
                          (other->ground_map.normal.dot(place) - other->ground_map.distance);
    return std::abs(step_m) > max_step_m_;
  }

 private:
  const FloorNode* find(FloorId id) const {
    for (const FloorNode& floor : graph_.floors) {
      if (floor.id == id) return &floor;
    }
    return nullptr;
  }

  const GraphSnapshot& graph_;
  double max_step_m_;
};

}  // namespace

struct LoopCloser::Candidate {
  std::size_t index = 0;       ///< of the old keyframe
  Pose T_old_new_guess = Pose::Identity();
  double distance_m = 0.0;
  double similarity = 0.0;
};

void LoopCloser::describe(const Keyframes& keyframes) {
  for (std::size_t i = contexts_.size(); i < keyframes.size(); ++i) {
    contexts_.emplace_back();
    if (keyframes[i].cloud != nullptr) {
      contexts_.back() =
          std::make_unique<ScanContext>(*keyframes[i].cloud, levelRotation(keyframes[i]));
    }
    const double step_m =
        i == 0 ? 0.0
               : (keyframes[i].T_odom_base.translation() -
                  keyframes[i - 1].T_odom_base.translation()).norm();
    path_m_.push_back(i == 0 ? 0.0 : path_m_.back() + step_m);
  }
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    if (keyframes[i].cloud == nullptr) contexts_[i].reset();
  }
}

std::vector<LoopCloser::Candidate> LoopCloser::candidates(
    const GraphSnapshot& graph, const std::vector<Matrix6>& uncertainty) const {
  const Keyframes& keyframes = graph.keyframes;
  const Levels levels(graph, config_.max_level_step_m);
  const std::size_t newest = keyframes.size() - 1;
  std::vector<Candidate> near;
  for (std::size_t i = 0; i < newest && path_m_[newest] - path_m_[i] > config_.min_path_m; ++i) {
    if (contexts_[i] == nullptr) continue;
    if (levels.areTwoStoreys(keyframes[i], keyframes[newest])) continue;
    Candidate candidate;
    candidate.index = i;
    candidate.T_old_new_guess =
        keyframes[i].T_map_base.inverse() * keyframes[newest].T_map_base;
    candidate.distance_m = candidate.T_old_new_guess.translation().norm();
    const double sigma_m = std::sqrt(uncertainty[i].topLeftCorner<3, 3>().trace());
    const double radius_m =
        std::clamp(kRadiusSigmas * sigma_m, config_.min_radius_m, config_.max_radius_m);
    if (candidate.distance_m < radius_m) near.push_back(candidate);
  }
  if (near.empty()) return near;

  std::sort(near.begin(), near.end(),
            [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
  std::vector<Candidate> chosen{near.front()};
  for (Candidate& candidate : near) {
    const auto comparison = contexts_[candidate.index]->compare(*contexts_[newest]);
    candidate.similarity = comparison.similarity;
    const Eigen::Matrix3d R_level_old = levelRotation(keyframes[candidate.index]);
    const Eigen::Matrix3d R_level_new = levelRotation(keyframes[newest]);
    candidate.T_old_new_guess.setIdentity();
    candidate.T_old_new_guess.linear() =
        R_level_old.transpose() *
        Eigen::AngleAxisd(comparison.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
        R_level_new;
  }
  std::sort(near.begin(), near.end(),
            [](const auto& a, const auto& b) { return a.similarity > b.similarity; });
  for (const Candidate& candidate : near) {
    if (chosen.size() >= static_cast<std::size_t>(config_.max_candidates)) break;
    if (candidate.similarity < kMinSimilarity) break;
    chosen.push_back(candidate);
  }
  return chosen;
}

std::optional<LoopClosure> LoopCloser::verify(const Candidate& candidate,
                                              const Keyframes& keyframes,
                                              const Matrix6& uncertainty) const {
  const KeyframeNode& old = keyframes[candidate.index];
  const KeyframeNode& newest = keyframes.back();

  VoxelMap submap(config_.map);
  const Pose T_old_map = old.T_map_base.inverse();
  const std::size_t reach = static_cast<std::size_t>(config_.submap_keyframes / 2);
  const std::size_t from = candidate.index > reach ? candidate.index - reach : 0;
  for (std::size_t i = from; i <= candidate.index + reach && i + 1 < keyframes.size(); ++i) {
    if (keyframes[i].cloud == nullptr) continue;
    const Pose T_old_other = T_old_map * keyframes[i].T_map_base;
    const Cloud& cloud = *keyframes[i].cloud;
    const Eigen::Vector3d viewpoint =
        T_old_other * viewpointOf(cloud);
    for (const Point& p : cloud) {
      submap.insert(T_old_other * Eigen::Vector3d(p.getVector3fMap().cast<double>()), viewpoint);
    }
  }
  submap.refit();

  MotionPrior prior;
  prior.mean.T_map_base = candidate.T_old_new_guess;
  // says next to nothing, but keeps the equations solvable where the points do not
  prior.information = 1e-2 * Matrix12::Identity();
  const RegistrationResult fit =
      registerScan(registrationPoints(*newest.cloud), submap, prior, {prior.mean, VoxelMap::kLevels - 1},
                   viewpointOf(*newest.cloud), config_.registration);
  if (!fit.converged || fit.degenerate_directions > 0 || fit.inlier_ratio < config_.min_overlap ||
      fit.rms_m > config_.max_rms_m) {
    return std::nullopt;
  }

  Tangent floor;
  floor << Eigen::Vector3d::Constant(config_.sigma_floor_m * config_.sigma_floor_m),
      Eigen::Vector3d::Constant(config_.sigma_floor_rad * config_.sigma_floor_rad);
  const Matrix6 covariance = fit.information.inverse() + Matrix6(floor.asDiagonal());
  const Tangent surprise = local(old.T_map_base.inverse() * newest.T_map_base,
                                 fit.estimate.T_map_base);
  const Matrix6 gate = kGateInflation * uncertainty + covariance;
  if (surprise.dot(gate.ldlt().solve(surprise)) > config_.max_chi2) return std::nullopt;
  if (!old.floor || !newest.floor) {
    const Eigen::Vector3d up_old = T_old_map.linear().col(2);
    const Eigen::Vector3d up_newest = newest.T_map_base.linear().row(2).transpose();
    const double sigma_m =
        std::sqrt(up_newest.dot(uncertainty.topLeftCorner<3, 3>() * up_newest));
    const double climb_m = up_old.dot(fit.estimate.T_map_base.translation() -
                                      T_old_map * newest.T_map_base.translation());
    if (std::abs(climb_m) > std::max(config_.max_climb_m, kClimbSigmas * sigma_m)) {
      return std::nullopt;
    }
  }

  return LoopClosure{old.id, newest.id, fit.estimate.T_map_base, covariance.inverse()};
}

std::vector<LoopClosure> LoopCloser::find(const GraphSnapshot& graph) {
  const Keyframes& keyframes = graph.keyframes;
  if (!config_.enabled || keyframes.empty()) return {};
  describe(keyframes);
  if (contexts_.back() == nullptr) return {};
  if (path_m_.back() - searched_at_m_ < config_.min_interval_m) return {};
  if (path_m_.back() < config_.min_path_m) return {};
  searched_at_m_ = path_m_.back();

  const std::vector<Matrix6> uncertainty = uncertaintyToNewest(graph);
  std::vector<LoopClosure> loops;
  for (const Candidate& candidate : candidates(graph, uncertainty)) {
    const auto loop = verify(candidate, keyframes, uncertainty[candidate.index]);
    if (!loop) continue;
    loops.push_back(*loop);
    break;  // one good loop a search is enough: further ones repeat its points
  }
  return loops;
}

std::optional<LoopClosure> LoopCloser::confirm(const GraphSnapshot& graph, KeyframeId old,
                                               const Pose& T_old_newest) const {
  if (!config_.enabled || graph.keyframes.empty()) return std::nullopt;
  if (graph.keyframes.back().cloud == nullptr) return std::nullopt;
  for (std::size_t k = 0; k + 1 < graph.keyframes.size(); ++k) {
    if (graph.keyframes[k].id != old) continue;
    if (graph.keyframes[k].cloud == nullptr) return std::nullopt;
    Candidate candidate;
    candidate.index = k;
    candidate.T_old_new_guess = T_old_newest;
    return verify(candidate, graph.keyframes, uncertaintyToNewest(graph)[k]);
  }
  return std::nullopt;
}

template <typename Archive>
void LoopCloser::archive(Archive& a) {
  std::vector<std::optional<ScanContext>> contexts;
  for (const auto& context : contexts_) {
    contexts.push_back(context == nullptr ? std::nullopt : std::make_optional(*context));
  }
  a("contexts", contexts);
  a("path_m", path_m_);
  a("searched_at_m", searched_at_m_);
  if constexpr (Archive::kReads) {
    contexts_.clear();
    for (const auto& context : contexts) {
      contexts_.push_back(context ? std::make_unique<ScanContext>(*context) : nullptr);
    }
  }
}

template void LoopCloser::archive(ArchiveWriter&);
template void LoopCloser::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
