// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/trajectory_error.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kDegreesPerRadian = 180.0 / 3.14159265358979323846;

/// Second over first singular value of the positions' cross-covariance, a ratio of squared lengths:
/// a path of 10 m that leaves its line by less than 10 um says nothing of the rotation about it.
constexpr double kMinSpreadRatio = 1e-12;

/// Positions spread over less than this [m^2] are one point.
constexpr double kMinSpread_m2 = 1e-12;

Trajectory sortedByTime(Trajectory trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
  return trajectory;
}

struct Candidate {
  double dt_s;
  std::size_t truth;
  std::size_t run;
};

/// Every two poses that are close enough, the closest first.
std::vector<Candidate> candidates(const Trajectory& truth, const Trajectory& run, double max_dt_s) {
  std::vector<Candidate> all;
  std::size_t first = 0;  // the first of the truth that is not too old for this pose or a later one
  for (std::size_t k = 0; k < run.size(); ++k) {
    while (first < truth.size() && truth[first].stamp_s < run[k].stamp_s - max_dt_s) ++first;
    for (std::size_t j = first; j < truth.size(); ++j) {
      const double dt_s = truth[j].stamp_s - run[k].stamp_s;
      if (dt_s > max_dt_s) break;
      all.push_back({std::abs(dt_s), j, k});
    }
  }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.dt_s, a.run, a.truth) < std::tie(b.dt_s, b.run, b.truth);
  });
  return all;
}

ErrorStatistics statistics(const std::vector<double>& errors) {
  return {rootMeanSquare(errors), mean(errors), quantile(errors, 0.5), quantile(errors, 1.0)};
}

/// What is left of the motion from `a` to `b` in the run after the true one is taken off.
Pose motionError(const PosePair& a, const PosePair& b) {
  const Pose truth = a.T_truth_body.inverse() * b.T_truth_body;
  const Pose run = a.T_run_body.inverse() * b.T_run_body;
  return truth.inverse() * run;
}

double angle_deg(const Pose& T) { return logSO3(T.linear()).norm() * kDegreesPerRadian; }

ScanToScanError scanToScanError(const std::vector<PosePair>& pairs) {
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const Pose error = motionError(pairs[k - 1], pairs[k]);
    translations_m.push_back(error.translation().norm());
    rotations_deg.push_back(angle_deg(error));
  }
  return {rootMeanSquare(translations_m), rootMeanSquare(rotations_deg)};
}

/// From every pose to the first one that is `length_m` or more along the true path.
RelativeError relativeError(const std::vector<PosePair>& pairs, double length_m) {
  std::vector<double> travelled_m(pairs.size(), 0.0);
  for (std::size_t k = 1; k < pairs.size(); ++k) {
    const Pose step = pairs[k - 1].T_truth_body.inverse() * pairs[k].T_truth_body;
    travelled_m[k] = travelled_m[k - 1] + step.translation().norm();
  }

  std::vector<double> percents;
  std::vector<double> degrees_per_m;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < pairs.size(); ++begin) {
    while (end < pairs.size() && travelled_m[end] - travelled_m[begin] < length_m) ++end;
    if (end == pairs.size()) break;
    const double path_m = travelled_m[end] - travelled_m[begin];
    const Pose error = motionError(pairs[begin], pairs[end]);
    percents.push_back(100.0 * error.translation().norm() / path_m);
    degrees_per_m.push_back(angle_deg(error) / path_m);
  }
  return {percents.size(), mean(percents), mean(degrees_per_m)};
}

}  // namespace

PairedTrajectories pairByTime(const Trajectory& truth, const Trajectory& run, double max_dt_s) {
  const Trajectory truth_sorted = sortedByTime(truth);
  const Trajectory run_sorted = sortedByTime(run);

  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> truth_of_run(run.size(), kNone);
  std::vector<bool> truth_taken(truth.size(), false);
  for (const Candidate& candidate : candidates(truth_sorted, run_sorted, max_dt_s)) {
    if (truth_taken[candidate.truth] || truth_of_run[candidate.run] != kNone) continue;
    truth_taken[candidate.truth] = true;
    truth_of_run[candidate.run] = candidate.truth;
  }

  PairedTrajectories result;
  for (std::size_t k = 0; k < run.size(); ++k) {
    if (truth_of_run[k] == kNone) continue;
    result.pairs.push_back(
        {truth_sorted[truth_of_run[k]].T_world_body, run_sorted[k].T_world_body});
  }
  result.run_unpaired = run.size() - result.pairs.size();
  result.truth_unpaired = truth.size() - result.pairs.size();
  return result;
}

Pose alignRun(const std::vector<PosePair>& pairs) {
  if (pairs.size() < 3) {
    throw std::runtime_error("cannot align: " + std::to_string(pairs.size()) +
                             " poses have a truth, three are needed");
  }
  Eigen::Vector3d centre_truth = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre_run = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    centre_truth += pair.T_truth_body.translation();
    centre_run += pair.T_run_body.translation();
  }
  const auto count = static_cast<double>(pairs.size());
  centre_truth /= count;
  centre_run /= count;

  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs) {
    covariance += (pair.T_truth_body.translation() - centre_truth) *
                  (pair.T_run_body.translation() - centre_run).transpose();
  }
  covariance /= count;

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d spread_m2 = svd.singularValues();
  if (spread_m2[0] < kMinSpread_m2 || spread_m2[1] < kMinSpreadRatio * spread_m2[0]) {
    throw std::runtime_error("cannot align: the " + std::to_string(pairs.size()) +
                             " positions lie on one line or at one point");
  }
  // The last direction is turned round where the best orthogonal matrix would be a mirror.
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;

  Pose T_truth_run = Pose::Identity();
  T_truth_run.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T_truth_run.translation() = centre_truth - T_truth_run.linear() * centre_run;
  return T_truth_run;
}

TrajectoryErrors evaluateTrajectory(const Trajectory& truth, const Trajectory& run,
                                    double max_dt_s) {
  const PairedTrajectories paired = pairByTime(truth, run, max_dt_s);

  TrajectoryErrors result;
  result.poses = run.size();
  result.paired = paired.pairs.size();
  result.run_unpaired = paired.run_unpaired;
  result.truth_unpaired = paired.truth_unpaired;
  result.T_truth_run = alignRun(paired.pairs);

  std::vector<double> distances_m;
  std::vector<double> heights_m;
  for (const PosePair& pair : paired.pairs) {
    const Eigen::Vector3d difference =
        result.T_truth_run * pair.T_run_body.translation() - pair.T_truth_body.translation();
    distances_m.push_back(difference.norm());
    heights_m.push_back(std::abs(difference.z()));
  }
  result.ate_m = statistics(distances_m);
  result.ate_z_m = statistics(heights_m);
  result.per_scan = scanToScanError(paired.pairs);
  result.over_1m = relativeError(paired.pairs, 1.0);
  result.over_10m = relativeError(paired.pairs, 10.0);
  return result;
}

}  // namespace mrpt_sgraphs
