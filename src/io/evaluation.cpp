// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/evaluation.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/io/map_files.h"
#include "mrpt_sgraphs/io/pcd_reader.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

fs::path truthFile(const fs::path& path) {
  if (!fs::exists(path)) throw std::runtime_error("there is no truth '" + path.string() + "'");
  if (!fs::is_directory(path)) return path;
  for (const fs::path& file : {path / "truth" / "trajectory.tum", path / "trajectory.tum"}) {
    if (fs::exists(file)) return file;
  }
  throw std::runtime_error("'" + path.string() +
                           "' holds neither truth/trajectory.tum nor trajectory.tum");
}

/// What the action returns; what it throws names the file.
template <typename Action>
auto naming(const fs::path& file, const Action& action) {
  try {
    return action();
  } catch (const std::exception& error) {
    throw std::runtime_error("'" + file.string() + "': " + error.what());
  }
}

TrajectoryErrors evaluateFile(const Truth& truth, const fs::path& file, double max_dt_s) {
  const Trajectory trajectory = readTum(file.string());
  return naming(file, [&] { return evaluateTrajectory(truth.trajectory, trajectory, max_dt_s); });
}

template <typename Node>
std::vector<Node> listOf(const SharedVector<Node>& nodes) {
  return {nodes.begin(), nodes.end()};
}

/// The layers of a graph against the building. What the building does not know is left out.
void evaluateLayers(const Truth& truth, const GraphSnapshot& graph, const Trajectory& run,
                    double max_dt_s, RunEvaluation* result) {
  const TrueBuilding& building = truth.building;
  const Pose& T_truth_map = result->trajectory.T_truth_run;
  if (!building.rooms.empty()) {
    result->rooms = evaluateRooms(building, listOf(graph.rooms), T_truth_map, truth.trajectory);
  }
  if (!building.floors.empty()) {
    const PairedTrajectories paired = pairByTime(truth.trajectory, run, max_dt_s);
    result->floors =
        evaluateFloors(building, truth.trajectory, graph, paired.pairs, T_truth_map, max_dt_s);
  }
  const bool has_sides = std::any_of(building.walls.begin(), building.walls.end(),
                                     [](const TrueWall& wall) { return wall.plane.has_value(); });
  if (has_sides) result->walls = evaluateWalls(building.walls, listOf(graph.walls), T_truth_map);
}

/// The grids of a graph's floors.
void evaluateGrids(const Truth& truth, const GraphSnapshot& graph, const fs::path& folder,
                   RunEvaluation* result) {
  constexpr double kHeight_m = 2.0;  // that a grid looks at, or less
  for (const FloorNode& floor : graph.floors) {
    const fs::path file = folder / ("floor_" + std::to_string(floor.id.value) + ".yaml");
    if (!fs::exists(file) || truth.building.surfaces.empty()) continue;
    const FloorGrid grid = readGrid(file.string());
    const Plane& ground = floor.ground_map;
    std::vector<Eigen::Vector3f> feet_map;
    grid.cells.forEach([&](Cell cell) {
      if (grid.cells[cell] != FloorGrid::kOccupied) return;
      const Eigen::Vector2d at(grid.cell_m * (cell.column + 0.5), grid.cell_m * (cell.row + 0.5));
      const double z =
          (ground.distance - ground.normal.head<2>().dot(at)) / ground.normal.z();
      feet_map.push_back(Eigen::Vector3d(at.x(), at.y(), z).cast<float>());
    });
    result->grids.emplace(
        floor.id.value, evaluateColumns(truth.building.surfaces, feet_map, kHeight_m,
                                        result->trajectory.T_truth_run));
  }
}

void evaluateGraph(const Truth& truth, const fs::path& folder, double max_dt_s,
                   RunEvaluation* result) {
  const fs::path file = folder / "graph.json";
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read '" + file.string() + "'");
  const LayeredGraph graph = readGraphJson(stream, file.string());
  result->surface_residuals = surfaceResiduals(graph);
  const Trajectory run = readTum((folder / "trajectory.tum").string());
  naming(file, [&] { evaluateLayers(truth, *graph.snapshot(), run, max_dt_s, result); });
  evaluateGrids(truth, *graph.snapshot(), folder, result);
}

}  // namespace

Truth readTruth(const std::string& path) {
  const fs::path file = truthFile(path);
  Truth truth;
  truth.path = file.string();
  truth.trajectory = readTum(file.string());
  const fs::path building = file.parent_path() / "building.json";
  if (fs::exists(building)) truth.building = readBuilding(building.string());
  return truth;
}

RunEvaluation evaluateRun(const Truth& truth, const std::string& run, double max_dt_s) {
  RunEvaluation result;
  result.name = run;
  const fs::path folder = run;
  if (!fs::exists(folder)) throw std::runtime_error("there is no run '" + run + "'");
  if (!fs::is_directory(folder)) {
    result.trajectory = evaluateFile(truth, folder, max_dt_s);
    return result;
  }

  result.trajectory = evaluateFile(truth, folder / "trajectory.tum", max_dt_s);
  const fs::path odometry = folder / "odometry.tum";
  if (fs::exists(odometry)) result.odometry = evaluateFile(truth, odometry, max_dt_s);
  const fs::path map = folder / "map.pcd";
  if (fs::exists(map) && !truth.building.surfaces.empty()) {
    result.map =
        evaluateMap(truth.building.surfaces, readPcd(map.string()), result.trajectory.T_truth_run);
  }
  const fs::path octomap = folder / "map.bt";
  if (fs::exists(octomap) && !truth.building.surfaces.empty()) {
    result.octomap = evaluateMap(truth.building.surfaces, readOccupiedCells(octomap.string()),
                                 result.trajectory.T_truth_run);
  }
  if (fs::exists(folder / "graph.json")) evaluateGraph(truth, folder, max_dt_s, &result);
  const fs::path optimizations = folder / "optimizations.csv";
  if (fs::exists(optimizations)) {
    result.optimizations = readOptimizationTimes(optimizations.string());
  }
  return result;
}

double reductionPercent(const RunEvaluation& run, const RunEvaluation& baseline) {
  const auto hasTimes = [](const RunEvaluation& r) {
    return r.optimizations && r.optimizations->all.count > 0 && r.optimizations->all.mean_ms > 0.0;
  };
  if (!hasTimes(run) || !hasTimes(baseline)) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * (1.0 - run.optimizations->all.mean_ms / baseline.optimizations->all.mean_ms);
}

}  // namespace mrpt_sgraphs
