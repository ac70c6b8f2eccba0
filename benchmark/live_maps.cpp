// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the maps of MapServer cost while a graph grows, and whether they follow it:
//
//     live_maps FRONT_END.bag [--drift RAD_PER_M] [--truth DIR] [--params FILE.yaml] [--csv FILE]
//
// After every keyframe the maps are brought up to date as the nodelet does it: a row of CPU
// milliseconds, points kept, voxels, and keyframes whose place changed by a cell. In the end they
// are compared, voxel by voxel, with maps that are made anew, and with the truth.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/io/evaluation.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "mrpt_sgraphs/mapping/floor_grid.h"
#include "mrpt_sgraphs/mapping/octree.h"
#include "mrpt_sgraphs/mapping/point_map.h"
#include "mrpt_sgraphs/mapping/room_clouds.h"
#include "mrpt_sgraphs/ros/front_end_bag.h"
#include "mrpt_sgraphs/slam/back_end.h"
#include "mrpt_sgraphs/slam/config_file.h"
#include "mrpt_sgraphs/slam/odometry_drift.h"

namespace mrpt_sgraphs {
namespace {

namespace po = boost::program_options;

constexpr double kMiB = 1024.0 * 1024.0;

struct Row {
  double stamp_s = 0.0;
  std::size_t keyframes = 0;
  double clouds_ms = 0.0;
  double occupancy_ms = 0.0;
  double points_ms = 0.0;
  std::size_t points_kept = 0;
  std::size_t points_whole = 0;  ///< Of all the clouds that ever came.
  std::size_t voxels = 0;
  double blocks_MiB = 0.0;
};

/// As MapServer has them.
class LiveMaps {
 public:
  explicit LiveMaps(const MapConfig& config)
      : clouds_(config.cell_m), occupancy(config), points(config.points_voxel_m) {}

  Row update(GraphSnapshot graph) {
    Row row;
    row.stamp_s = graph.stamp_s;
    row.keyframes = graph.keyframes.size();
    if (!graph.keyframes.empty() && graph.keyframes.back().cloud != nullptr) {
      whole_ += graph.keyframes.back().cloud->size();
    }
    CpuStopwatch watch;
    clouds_.attachTo(&graph);
    row.clouds_ms = watch.lap();
    occupancy.update(graph);
    row.occupancy_ms = watch.lap();
    points.update(graph);
    row.points_ms = watch.lap();
    row.points_kept = clouds_.points();
    row.points_whole = whole_;
    row.voxels = occupancy.size();
    row.blocks_MiB = static_cast<double>(occupancy.bytes()) / kMiB;
    last = graph;
    return row;
  }

 private:
  RoomClouds clouds_;
  std::size_t whole_ = 0;

 public:
  OccupancyMap occupancy;
  PointMap points;
  GraphSnapshot last;  ///< With the clouds that the maps are of.
};

struct Replayed {
  std::vector<Row> rows;
  RunRecord record;
};

Replayed replay(const std::string& bag_path, const SlamConfig& config, double drift_rad_per_m,
                LiveMaps* maps) {
  Replayed result;
  BackEnd back_end(config);
  FrontEndBag bag({bag_path}, 0.0, 0.0);
  OdometryDrift drift(drift_rad_per_m);
  FrontEndHandlers handlers;
  handlers.scan = [&](ScanMotion scan, const ScanReport& report) {
    drift.apply(&scan);
    back_end.addScan(scan, report);
  };
  handlers.keyframe = [&](Keyframe keyframe, double segment_ms) {
    drift.apply(&keyframe);
    back_end.addKeyframe(keyframe, segment_ms);
    result.rows.push_back(maps->update(*back_end.graph()));
  };
  handlers.remark = [](const std::string&, double, const std::string& remark) {
    std::cerr << remark << '\n';
  };
  handlers.progress = [](double) {};
  const std::string damage = bag.play(handlers);
  if (!damage.empty()) throw std::runtime_error(damage);
  back_end.finish();
  result.rows.push_back(maps->update(*back_end.graph()));
  result.record = back_end.record();
  return result;
}

void writeCsv(const std::string& path, const std::vector<Row>& rows) {
  std::ofstream out(path);
  out << "stamp,keyframes,clouds_ms,occupancy_ms,points_ms,points_kept,points_whole,voxels,"
         "blocks_mib\n";
  for (const Row& r : rows) {
    out << std::fixed << r.stamp_s << ',' << r.keyframes << ',' << r.clouds_ms << ','
        << r.occupancy_ms << ',' << r.points_ms << ',' << r.points_kept << ',' << r.points_whole
        << ',' << r.voxels << ',' << r.blocks_MiB << '\n';
  }
}

void printTimes(const char* name, const std::vector<Row>& rows, double Row::*milliseconds) {
  std::vector<double> values;
  double sum = 0.0;
  for (const Row& row : rows) {
    values.push_back(row.*milliseconds);
    sum += values.back();
  }
  const double most = *std::max_element(values.begin(), values.end());
  std::printf("%-12s %8.2f %8.2f %8.2f %8.2f\n", name, sum / static_cast<double>(values.size()),
              quantile(values, 0.5), quantile(values, 0.95), most);
}

/// Voxels of which two maps do not say the same.
std::size_t differences(const OccupancyMap& a, const OccupancyMap& b) {
  std::size_t different = 0;
  a.forEachKnown([&](const Voxel& voxel, bool) {
    different += a.evidenceAt(voxel) == b.evidenceAt(voxel) ? 0 : 1;
  });
  b.forEachKnown([&](const Voxel& voxel, bool) { different += a.evidenceAt(voxel) == 0 ? 1 : 0; });
  return different;
}

/// Voxels of which one says occupied and the other free.
std::size_t contradictions(const OccupancyMap& a, const OccupancyMap& b) {
  std::size_t opposite = 0;
  a.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    const int other = b.evidenceAt(voxel);
    opposite += other != 0 && (other > 0) != is_occupied ? 1 : 0;
  });
  return opposite;
}

std::vector<Eigen::Vector3f> occupiedIn(const OccupancyMap& map) {
  std::vector<Eigen::Vector3f> centres;
  map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    if (is_occupied) centres.push_back(map.centreOf(voxel).cast<float>());
  });
  return centres;
}

void printError(const char* name, const std::vector<Eigen::Vector3f>& points_map,
                const Truth& truth, const Pose& T_truth_map) {
  const MapError error = evaluateMap(truth.building.surfaces, points_map, T_truth_map);
  std::printf("%-24s %8zu points, median %.3f m, farther than %.2f m: %.2f %%\n", name,
              error.points, error.median_m, kFar_m, 100.0 * error.far_share);
}

void compareWithTruth(const std::string& path, const LiveMaps& maps, const OccupancyMap& anew,
                      const RunRecord& record) {
  constexpr double kMaxDt_s = 0.01;
  const Truth truth = readTruth(path);
  const TrajectoryErrors errors =
      evaluateTrajectory(truth.trajectory, record.trajectory, kMaxDt_s);
  const TrajectoryErrors odometry = evaluateTrajectory(truth.trajectory, record.odometry, kMaxDt_s);
  std::printf("ATE of the odometry %.3f m, of the graph %.3f m\n", odometry.ate_m.rmse,
              errors.ate_m.rmse);
  printError("OctoMap, as it grew", occupiedIn(maps.occupancy), truth, errors.T_truth_run);
  printError("OctoMap, made anew", occupiedIn(anew), truth, errors.T_truth_run);
  std::vector<Eigen::Vector3f> points_map;
  const Cloud::ConstPtr cloud = maps.points.cloud();
  for (const Point& point : *cloud) points_map.push_back(point.getVector3fMap());
  printError("map_points, as they grew", points_map, truth, errors.T_truth_run);
}

void run(const po::variables_map& values) {
  const SlamConfig config = values.count("params") > 0
                                ? loadConfigFile(values["params"].as<std::string>())
                                : SlamConfig{};
  LiveMaps maps(config.map);
  const Replayed replayed = replay(values["bag"].as<std::string>(), config,
                                   values["drift"].as<double>(), &maps);
  const std::vector<Row>& rows = replayed.rows;
  if (values.count("csv") > 0) writeCsv(values["csv"].as<std::string>(), rows);

  std::printf("%zu keyframes\n\nCPU ms a keyframe     mean      p50      p95      max\n",
              rows.back().keyframes);
  printTimes("clouds", rows, &Row::clouds_ms);
  printTimes("occupancy", rows, &Row::occupancy_ms);
  printTimes("points", rows, &Row::points_ms);
  CpuStopwatch watch;
  const auto tree = octreeOf(maps.occupancy);
  const double tree_ms = watch.lap();
  const auto grids = floorGrids(maps.occupancy, maps.last, config.map);
  const double grids_ms = watch.lap();
  const std::size_t points = maps.points.cloud()->size();
  std::printf("to publish: OctoMap of %zu nodes %.0f ms, %zu grids %.0f ms, %zu points %.0f ms\n",
              tree->size(), tree_ms, grids.size(), grids_ms, points, watch.lap());
  const Row& last = rows.back();
  std::printf("kept: %zu of %zu points (%.1f of %.1f MiB), %zu voxels in %.1f MiB\n",
              last.points_kept, last.points_whole,
              static_cast<double>(last.points_kept * sizeof(Point)) / kMiB,
              static_cast<double>(last.points_whole * sizeof(Point)) / kMiB, last.voxels,
              last.blocks_MiB);

  OccupancyMap anew(config.map);
  anew.update(maps.last);
  std::printf("made anew in %.0f ms: %zu of %zu voxels have other evidence, %zu contradict\n",
              watch.lap(), differences(maps.occupancy, anew), anew.size(),
              contradictions(maps.occupancy, anew));
  if (values.count("truth") > 0) {
    compareWithTruth(values["truth"].as<std::string>(), maps, anew, replayed.record);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  po::options_description description("live_maps FRONT_END.bag [options]");
  auto add = description.add_options();
  add("bag", po::value<std::string>()->required(), "as sgraphs_offline --record writes it");
  add("drift", po::value<double>()->default_value(0.0), "of the odometry [rad per metre]");
  add("truth", po::value<std::string>(), "as sgraphs_simulate writes it");
  add("params", po::value<std::string>(), "parameter file");
  add("csv", po::value<std::string>(), "a row for every keyframe");
  po::positional_options_description first;
  first.add("bag", 1);
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(description).positional(first).run(),
              values);
    po::notify(values);
    mrpt_sgraphs::run(values);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "live_maps: " << error.what() << '\n';
    return 1;
  }
}
