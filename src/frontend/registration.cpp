// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// At this distance a rotation moves points as much as it is compared with in `min_eigenvalue`.
constexpr double kLever_m = 5.0;
/// Steps smaller than these change nothing that the sensor could show.
constexpr double kSmallStep_m = 2e-4;
constexpr double kSmallStep_rad = 4e-5;
/// Coarse cells lead until steps are smaller than this, or for so many iterations a level.
constexpr double kCoarseStep_m = 0.02;
constexpr double kCoarseStep_rad = 0.003;
constexpr int kCoarseIterations = 8;
/// How much farther from its plane a point may be with each level.
constexpr double kWiderGate = 2.0;
/// A degenerate direction is held at the prediction this stiffly [1/m^2].
constexpr double kHold = 1e7;
/// Fewer matches than this are an accident.
constexpr int kMinMatches = 30;

/// exp(theta) p without trigonometry: exact to 1e-6 for the angles of a sweep (below 0.8 rad).
inline Eigen::Vector3d rotateLittle(const Eigen::Vector3d& theta, const Eigen::Vector3d& p) {
  const double s = theta.squaredNorm();
  if (s > 0.64) return expSO3(theta) * p;
  const double a = 1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0));
  const double b = 0.5 - s / 24.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0));
  const Eigen::Vector3d cross = theta.cross(p);
  return p + a * cross + b * theta.cross(cross);
}

/// A point with the plane that it lies on.
struct Match {
  Eigen::Vector3d base;    ///< the point in the base frame at the stamp, motion removed
  Eigen::Vector3d normal;  ///< map frame
  double distance = 0.0;   ///< signed, to the plane [m]
  double variance = 0.0;   ///< of that distance [m^2]
  double time_s = 0.0;
};

std::vector<Match> match(const std::vector<ScanPoint>& points, const VoxelMap& map,
                         const MovingPose& pose, const Eigen::Vector3d& viewpoint_base,
                         const RegistrationConfig& config, int level) {
  std::vector<Match> matches;
  const double max_distance_m = config.max_distance_m * std::pow(kWiderGate, level);
  matches.reserve(points.size());
  const Eigen::Vector3d viewpoint_map = pose.T_map_base * viewpoint_base;
  for (const ScanPoint& point : points) {
    Match m;
    m.base = pointAtStamp(point, pose.velocity_base);
    const Eigen::Vector3d point_map = pose.T_map_base * m.base;
    const MapPlane* plane = map.find(point_map, viewpoint_map, level);
    if (plane == nullptr) continue;
    m.distance = plane->normal.dot(point_map - plane->centre);
    if (std::abs(m.distance) > max_distance_m) continue;
    m.normal = plane->normal;
    m.variance = config.range_sigma_m * config.range_sigma_m + plane->variance_m2;
    m.time_s = point.time_s;
    matches.push_back(m);
  }
  return matches;
}

/// 1.4826 times the median absolute distance: one sigma, whatever the outliers do.
double robustScale(const std::vector<Match>& matches) {
  std::vector<double> distances;
  distances.reserve(matches.size());
  for (const Match& m : matches) distances.push_back(std::abs(m.distance));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 1.4826 * *middle;
}

/// The points' share of the normal equations: moments of J'J and J'e over time.
struct NormalEquations {
  Matrix6 h0 = Matrix6::Zero();
  Matrix6 h1 = Matrix6::Zero();
  Matrix6 h2 = Matrix6::Zero();
  Tangent g0 = Tangent::Zero();
  Tangent g1 = Tangent::Zero();

  /// Of the pose with the velocity eliminated.
  Matrix6 poseInformation(const Matrix6& velocity_prior) const {
    const Matrix6 h22 = h2 + velocity_prior;
    return h0 - h1 * h22.ldlt().solve(h1.transpose());
  }
};

NormalEquations accumulate(const std::vector<Match>& matches, const Pose& T_map_base,
                           double scale_m) {
  NormalEquations sum;
  const Eigen::Matrix3d R_base_map = T_map_base.linear().transpose();
  for (const Match& m : matches) {
    const double kernel_variance = std::max(scale_m * scale_m, m.variance);
    const double weight =
        1.0 / (m.variance * (1.0 + m.distance * m.distance / kernel_variance));  // Cauchy
    Tangent j;
    j.head<3>() = R_base_map * m.normal;
    j.tail<3>() = m.base.cross(j.head<3>());
    const Matrix6 jj = (weight * j) * j.transpose();
    const Tangent je = (weight * m.distance) * j;
    sum.h0 += jj;
    sum.g0 += je;
    if (m.time_s != 0.0) {
      sum.h1 += m.time_s * jj;
      sum.h2 += (m.time_s * m.time_s) * jj;
      sum.g1 += m.time_s * je;
    }
  }
  return sum;
}

/// Directions of the pose (columns, unit length with rotations at kLever_m) with too little
/// information.
Eigen::Matrix<double, 6, Eigen::Dynamic> degenerateDirections(const Matrix6& information,
                                                              double min_eigenvalue) {
  Tangent scale;
  scale << 1.0, 1.0, 1.0, Eigen::Vector3d::Constant(1.0 / kLever_m);
  const Matrix6 scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scaled);
  int count = 0;
  while (count < 6 && eigen.eigenvalues()[count] < min_eigenvalue) ++count;
  return scale.cwiseInverse().asDiagonal() * eigen.eigenvectors().leftCols(count);
}

}  // namespace

Eigen::Vector3d pointAtStamp(const ScanPoint& point, const Tangent& velocity_base) {
  if (point.time_s == 0.0) return point.position;
  return rotateLittle(point.time_s * velocity_base.tail<3>(), point.position) +
         point.time_s * velocity_base.head<3>();
}

RegistrationResult registerScan(const std::vector<ScanPoint>& points, const VoxelMap& map,
                                const MotionPrior& prior, const RegistrationStart& start,
                                const Eigen::Vector3d& viewpoint_base,
                                const RegistrationConfig& config) {
  RegistrationResult result;
  result.estimate = start.pose;
  int level = start.level;
  int iterations_at_level = 0;

  for (result.iterations = 0; result.iterations < config.max_iterations && !result.converged;
       ++result.iterations) {
    const std::vector<Match> matches =
        match(points, map, result.estimate, viewpoint_base, config, level);
    result.matched = static_cast<int>(matches.size());
    if (result.matched < kMinMatches) break;
    const double scale_m = robustScale(matches);

    const NormalEquations data = accumulate(matches, result.estimate.T_map_base, scale_m);
    result.information = data.poseInformation(prior.information.bottomRightCorner<6, 6>());
    const auto weak = degenerateDirections(result.information, config.min_eigenvalue);
    result.degenerate_directions = static_cast<int>(weak.cols());

    Matrix12 h = prior.information;
    h.topLeftCorner<6, 6>() += data.h0;
    h.topRightCorner<6, 6>() += data.h1;
    h.bottomLeftCorner<6, 6>() += data.h1;
    h.bottomRightCorner<6, 6>() += data.h2;
    result.posterior_information = h;

    Vector12 off;  // from the prior's mean
    off << local(prior.mean.T_map_base, result.estimate.T_map_base),
        result.estimate.velocity_base - prior.mean.velocity_base;
    const Matrix6 hold = kHold * weak * weak.transpose();
    h.topLeftCorner<6, 6>() += hold;
    Vector12 g = prior.information * off;
    g.head<6>() += data.g0 + hold * off.head<6>();
    g.tail<6>() += data.g1;
    const Vector12 step = h.ldlt().solve(-g);
    if (!step.allFinite()) break;

    result.estimate.T_map_base = retract(result.estimate.T_map_base, step.head<6>());
    result.estimate.velocity_base += step.tail<6>();
    const double step_m = step.head<3>().norm();
    const double step_rad = step.segment<3>(3).norm();
    if (level == 0) {
      result.converged = step_m < kSmallStep_m && step_rad < kSmallStep_rad;
    } else if ((step_m < kCoarseStep_m && step_rad < kCoarseStep_rad) ||
               ++iterations_at_level >= kCoarseIterations) {
      --level;
      iterations_at_level = 0;
    }
  }

  result.estimate.T_map_base = orthonormalized(result.estimate.T_map_base);
  const std::vector<Match> matches =
      match(points, map, result.estimate, viewpoint_base, config, 0);
  double sum = 0.0;
  result.matched = 0;
  for (const Match& m : matches) {
    constexpr double kOnPlane = 3.0;  // sigmas
    if (m.distance * m.distance > kOnPlane * kOnPlane * m.variance) continue;
    sum += m.distance * m.distance;
    ++result.matched;
  }
  result.inlier_ratio =
      points.empty() ? 0.0 : static_cast<double>(result.matched) / static_cast<double>(points.size());
  result.consistency = matches.empty() ? 0.0
                                       : static_cast<double>(result.matched) /
                                             static_cast<double>(matches.size());
  result.rms_m = result.matched > 0 ? std::sqrt(sum / result.matched) : 0.0;
  result.converged = result.converged && result.matched >= kMinMatches;
  return result;
}

}  // namespace mrpt_sgraphs
