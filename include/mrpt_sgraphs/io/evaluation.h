// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/io/building_file.h"
#include "mrpt_sgraphs/io/floor_error.h"
#include "mrpt_sgraphs/io/map_error.h"
#include "mrpt_sgraphs/io/optimization_times.h"
#include "mrpt_sgraphs/io/room_error.h"
#include "mrpt_sgraphs/io/surface_residuals.h"
#include "mrpt_sgraphs/io/trajectory_error.h"
#include "mrpt_sgraphs/io/tum.h"
#include "mrpt_sgraphs/io/wall_error.h"

namespace mrpt_sgraphs {

/// What really happened.
struct Truth {
  std::string path;  ///< Of the trajectory.
  Trajectory trajectory;
  TrueBuilding building;  ///< Of the building.json beside it; empty without one.
};

/// Reads a truth: a .tum file, or a folder with trajectory.tum in it or in its folder truth.
/// @throws std::runtime_error naming the file and what is wrong with it.
Truth readTruth(const std::string& path);

/// A run against the truth. What its folder does not have is not there.
struct RunEvaluation {
  std::string name;  ///< Its path, as given.
  TrajectoryErrors trajectory;
  std::optional<TrajectoryErrors> odometry;
  std::optional<MapError> map;      ///< map.pcd,
  std::optional<MapError> octomap;  ///< the occupied cells of map.bt,
  std::map<uint64_t, MapError> grids;  ///< and those of each floor's grid.
  std::optional<WallErrors> walls;    ///< If the truth says to which side its walls look.
  std::optional<RoomErrors> rooms;    ///< If the truth knows of any.
  std::optional<FloorErrors> floors;  ///< If the truth knows of any.
  std::optional<SurfaceResiduals> surface_residuals;
  std::optional<OptimizationTimes> optimizations;
};

/// Evaluates a folder of sgraphs_offline, or a .tum file alone.
/// @param max_dt_s  Poses farther apart in time are not of the same scan.
/// @throws std::runtime_error naming the file and what is wrong with it.
RunEvaluation evaluateRun(const Truth& truth, const std::string& run, double max_dt_s);

/// By how much the mean optimization time lies below that of the baseline [%]; NaN where either run
/// has none.
double reductionPercent(const RunEvaluation& run, const RunEvaluation& baseline);

/// Tables to read; the first run is the baseline of the others.
std::string evaluationTable(const Truth& truth, const std::vector<RunEvaluation>& runs);

/// The same as one JSON object; what there is not is null.
std::string evaluationJson(const Truth& truth, const std::vector<RunEvaluation>& runs);

}  // namespace mrpt_sgraphs
