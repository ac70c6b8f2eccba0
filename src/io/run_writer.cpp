// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/run_writer.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <locale>
#include <optional>
#include <stdexcept>

#include "mrpt_sgraphs/io/cloud_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/floor_plan.h"
#include "mrpt_sgraphs/io/folder_version.h"
#include "mrpt_sgraphs/io/geojson.h"
#include "mrpt_sgraphs/io/graphml.h"
#include "mrpt_sgraphs/io/map_files.h"
#include "mrpt_sgraphs/io/state_files.h"
#include "mrpt_sgraphs/mapping/map_cloud.h"
#include "run_report.h"

namespace mrpt_sgraphs {
namespace {

/// In a folder that nobody knows yet, which is brought to the disk as a whole.
template <typename Write>
void writeFile(const std::string& path, const Write& write) {
  std::ofstream file(path, std::ios::binary);
  file.imbue(std::locale::classic());
  write(file);
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
}

void writeOptimizations(const std::vector<OptimizationSummary>& rows, std::ostream& out) {
  out << "stamp,kind,mode,room,keyframes_active,keyframes_marginalized,dropped,walls,rooms,floors,"
         "factors,free_variables,iterations,cost_before,cost_after,converged,total_ms,linearize_ms,"
         "factorize_ms\n";
  for (const OptimizationSummary& r : rows) {
    out << std::fixed << std::setprecision(6) << r.stamp_s << ',' << r.kind << ',' << r.mode << ','
        << (r.room ? std::to_string(r.room->value) : "") << ',' << r.keyframes_active << ','
        << r.keyframes_marginalized << ',' << r.dropped << ',' << r.walls << ','
        << r.rooms << ',' << r.floors << ',' << r.factors << ',' << r.free_variables << ','
        << r.iterations << ',' << r.cost_before << ',' << r.cost_after << ','
        << (r.converged ? 1 : 0) << ',' << std::setprecision(3) << r.total_ms << ','
        << r.linearize_ms << ',' << r.factorize_ms << '\n';
  }
}

void writeScans(const std::vector<ScanReport>& rows, std::ostream& out) {
  out << "stamp,prefilter_ms,deskew_ms,register_ms,map_ms,select_ms,segment_ms,keyframe_ms,"
         "rooms_ms,rss_mib,registered,keyframe\n";
  for (const ScanReport& r : rows) {
    out << std::fixed << std::setprecision(6) << r.stamp_s << std::setprecision(3) << ','
        << r.prefilter_ms << ',' << r.deskew_ms << ',' << r.register_ms << ',' << r.map_ms << ','
        << r.select_ms << ',' << r.segment_ms << ',' << r.keyframe_ms << ',' << r.rooms_ms << ','
        << r.rss_mib << ','
        << (r.registered ? 1 : 0) << ',' << (r.keyframe ? 1 : 0) << '\n';
  }
}

Trajectory keyframeTrajectory(const GraphSnapshot& graph) {
  Trajectory trajectory;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    trajectory.push_back({keyframe.stamp_s, keyframe.T_map_base});
  }
  return trajectory;
}

/// As a file for --params: `section/field` by sections.
void writeParameters(const std::map<std::string, std::string>& parameters, std::ostream& out) {
  std::string section;
  for (const auto& [name, value] : parameters) {
    const std::size_t slash = name.find('/');
    if (name.substr(0, slash) != section) {
      section = name.substr(0, slash);
      out << section << ":\n";
    }
    out << "  " << name.substr(slash + 1) << ": " << value << '\n';
  }
}

void writeFloorPlans(const std::filesystem::path& folder, const GraphSnapshot& graph) {
  const auto write = [&](const std::string& name, std::optional<FloorId> floor) {
    writeFile((folder / name).string(),
              [&](std::ostream& out) { writeFloorPlan(graph, floor, out); });
  };
  for (const FloorNode& floor : graph.floors) {
    write("floor_" + std::to_string(floor.id.value) + ".svg", floor.id);
  }
  if (graph.floors.empty()) write("no_floor.svg", std::nullopt);
}

void writeFiles(const std::filesystem::path& folder, const RunRecord& run) {
  const auto in = [&folder](const std::string& name) { return (folder / name).string(); };
  writeTum(in("trajectory.tum"), run.trajectory);
  writeTum(in("odometry.tum"), run.odometry);
  writeTum(in("keyframes.tum"), keyframeTrajectory(*run.graph));
  writeFile(in("graph.json"), [&](std::ostream& out) { writeGraphJson(*run.graph, out); });
  writeFile(in("graph.g2o"), [&](std::ostream& out) { writeG2o(*run.graph, out); });
  writeFile(in("graph.graphml"), [&](std::ostream& out) { writeGraphMl(*run.graph, out); });
  writeFile(in("rooms.geojson"), [&](std::ostream& out) { writeGeoJson(*run.graph, out); });
  writeFloorPlans(folder, *run.graph);
  writeFile(in("map.pcd"), [&](std::ostream& out) {
    writePcd(*mapCloud(*run.graph, run.map_resolution_m), out);
  });
  writeMapFiles(folder, *run.graph, run.map);
  writeFile(in("optimizations.csv"),
            [&](std::ostream& out) { writeOptimizations(run.optimizations, out); });
  writeFile(in("scans.csv"), [&](std::ostream& out) { writeScans(run.scans, out); });
  writeFile(in("report.json"), [&](std::ostream& out) { writeReport(run, out); });
  writeFile(in("parameters.yaml"), [&](std::ostream& out) { writeParameters(run.parameters, out); });
  if (run.state.empty()) return;
  std::filesystem::create_directory(folder / "state");
  for (const auto& [name, bytes] : run.state) {
    writeFile(in(name), [&content = bytes](std::ostream& out) { out << content; });
  }
  std::filesystem::create_directory(folder / "clouds");
  for (const KeyframeNode& keyframe : run.graph->keyframes) {
    if (keyframe.cloud == nullptr) continue;
    writeFile(in(cloudFileOf(keyframe.id)),
              [&](std::ostream& out) { writeCloud(*keyframe.cloud, out); });
  }
}

}  // namespace

void requireWritableFolder(const std::string& folder) {
  FolderVersion version(folder);  // not committed
}

void writeRun(const std::string& folder, const RunRecord& run) {
  FolderVersion version(folder);
  writeFiles(version.folder(), run);
  version.commit();
}

}  // namespace mrpt_sgraphs
