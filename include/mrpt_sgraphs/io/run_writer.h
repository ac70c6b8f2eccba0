// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/tum.h"
#include "mrpt_sgraphs/mapping/map_config.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// A row of scans.csv.
struct ScanReport {
  double stamp_s = 0.0;
  double prefilter_ms = 0.0;  ///< CPU, as are the others
  double deskew_ms = 0.0;
  double register_ms = 0.0;
  double map_ms = 0.0;
  double select_ms = 0.0;    ///< Keyframe or not, thinning. Not known to nodelets.
  double segment_ms = 0.0;   ///< the planes of a keyframe
  double keyframe_ms = 0.0;  ///< The back end's work for it but for:
  double rooms_ms = 0.0;     ///< free space and rooms.
  double rss_mib = 0.0;      ///< Resident memory after a keyframe; 0 where the system does not tell.
  bool registered = false;
  bool keyframe = false;
};

/// Of a run that used a map and left it as it is.
struct LocalizationReport {
  bool localized = false;  ///< At the end,
  std::string problem;     ///< and if not, why.
  std::optional<double> first_after_s;  ///< When the place was known first, after the first scan,
  std::optional<double> first_after_m;  ///< and after how much way; none: never.
  int relocations = 0;  ///< How often the place was found,
  int losses = 0;       ///< and lost.
};

/// All that a run leaves behind, as values.
struct RunRecord {
  Trajectory trajectory;  ///< T_map_base of every scan, after the last optimization.
  Trajectory odometry;    ///< T_odom_base of every scan.
  GraphSnapshotConstPtr graph;
  std::optional<LocalizationReport> localization;  ///< None: the graph is what was made.
  std::vector<OptimizationSummary> optimizations;
  std::vector<ScanReport> scans;
  std::map<std::string, std::string> parameters;  ///< By their full names, as used.
  double data_s = 0.0;                            ///< Time that the data covers.
  double wall_s = 0.0;                            ///< Time that the run took.
  double map_resolution_m = 0.05;
  MapConfig map;  ///< Of the OctoMap and the grids.
  /// What is needed to go on, by the files' names; then the keyframes' clouds are written as well.
  std::map<std::string, std::string> state;
};

/// Makes a folder where it is missing and tries whether files can be made in it.
/// @throws std::runtime_error naming the folder and the reason if not.
void requireWritableFolder(const std::string& folder);

/// Writes a run as a FolderVersion: trajectory.tum, odometry.tum, keyframes.tum, graph.json,
/// graph.g2o, graph.graphml, rooms.geojson, map.pcd, map.bt, floor_<id>.svg, .pgm and .yaml,
/// optimizations.csv, scans.csv, report.json, parameters.yaml, and its state with the keyframes'
/// clouds. `folder` is then a link to all of it, or to all that was there before.
/// @throws std::runtime_error naming the file and the reason.
void writeRun(const std::string& folder, const RunRecord& run);

}  // namespace mrpt_sgraphs
