// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/building_file.h"
#include "mrpt_sgraphs/io/trajectory_error.h"
#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs {

/// How well the floors of a run are the storeys that the robot was on, and whether its keyframes
/// know theirs.
///
/// A found floor is a storey if its ground lies within 0.3 m of it, one to one and the nearest
/// first. On which storey the robot was, the height of its true positions tells; that of the body
/// above the ground is the one with which most of them stand on a storey.
///
/// A keyframe of a floor is right within 0.3 m of that storey; one of no floor is right more than
/// 0.1 m from all storeys, and in stairwells: at the foot of stairs, both are.
struct FloorErrors {
  /// A storey that the robot was on.
  struct Level {
    uint64_t id = 0;                ///< In the truth.
    double elevation_m = 0.0;       ///< In the truth.
    std::optional<uint64_t> found;  ///< In the run; without one, the next two are NaN.
    double height_error_m = std::numeric_limits<double>::quiet_NaN();  ///< At the floor's centre.
    double tilt_deg = std::numeric_limits<double>::quiet_NaN();        ///< Against level.
    std::size_t poses = 0;                                             ///< Of the trajectory on it,
    double z_mean_m = 0.0;    ///< and the error of their height: mean,
    double z_spread_m = 0.0;  ///< standard deviation: how far it is from flat,
    double z_rmse_m = 0.0;    ///< and both together.
  };

  std::vector<Level> levels;     ///< Upwards.
  std::size_t found = 0;         ///< Floors of the run;
  std::vector<uint64_t> wrong;   ///< those of them that are no storey, or one a second time.
  double between_error_m = 0.0;  ///< Greatest error of the height from one ground to the
                                 ///< next; NaN for fewer than two.
  std::size_t keyframes = 0;     ///< Of which the truth is known;
  std::vector<uint64_t> wrong_keyframes;  ///< those of them that say the wrong floor.

  bool exact() const;  ///< Every storey is one floor, and there are no others.
};

/// @param poses     Of the run's trajectory.
/// @param max_dt_s  Keyframes farther in time from all poses of the truth are passed over.
FloorErrors evaluateFloors(const TrueBuilding& truth, const Trajectory& truth_trajectory,
                           const GraphSnapshot& graph, const std::vector<PosePair>& poses,
                           const Pose& T_truth_map, double max_dt_s);

}  // namespace mrpt_sgraphs
