// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/geometry/pose.h"
#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs {

/// The same moment in the truth and in a run, each in its own world frame.
struct PosePair {
  Pose T_truth_body = Pose::Identity();
  Pose T_run_body = Pose::Identity();
};

/// Which poses of two trajectories belong together.
struct PairedTrajectories {
  std::vector<PosePair> pairs;  ///< In order of time.
  std::size_t run_unpaired = 0;
  std::size_t truth_unpaired = 0;
};

/// Pairs poses no more than max_dt_s apart, the closest first; none belongs to two pairs.
PairedTrajectories pairByTime(const Trajectory& truth, const Trajectory& run, double max_dt_s);

/// T_truth_run, the rigid motion that brings the positions of the run closest to those of the
/// truth:
///
///     argmin sum | p_truth - T_truth_run p_run |^2       (Umeyama 1991, without scale)
///
/// @throws std::runtime_error for fewer than three pairs, and for positions on one line (or at one
///         point), which leave a rotation open.
Pose alignRun(const std::vector<PosePair>& pairs);

/// The errors of a trajectory at its poses.
struct ErrorStatistics {
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
};

/// How far motions over a stretch of the truth's path are off, by the path's length. NaN where the
/// path is shorter than one stretch.
struct RelativeError {
  std::size_t segments = 0;
  double translation_percent = 0.0;  ///< Mean of the error over the stretch's length.
  double rotation_deg_per_m = 0.0;   ///< The same for the angle.
};

/// How far motions from one scan to the next are off.
struct ScanToScanError {
  double translation_rmse_m = 0.0;
  double rotation_rmse_deg = 0.0;
};

/// What a trajectory is worth, after alignRun over all pairs.
struct TrajectoryErrors {
  std::size_t poses = 0;
  std::size_t paired = 0;
  std::size_t run_unpaired = 0;    ///< Poses of the run without truth.
  std::size_t truth_unpaired = 0;  ///< Poses of the truth that the run lacks.
  Pose T_truth_run = Pose::Identity();
  ErrorStatistics ate_m;
  ErrorStatistics ate_z_m;  ///< Of the height alone: absolute differences.
  ScanToScanError per_scan;
  RelativeError over_1m;
  RelativeError over_10m;
};

/// @throws std::runtime_error as alignRun does.
TrajectoryErrors evaluateTrajectory(const Trajectory& truth, const Trajectory& run,
                                    double max_dt_s);

}  // namespace mrpt_sgraphs
