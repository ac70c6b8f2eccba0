// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/run_writer.h"

#include <filesystem>
#include <iomanip>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/map_files.h"
#include "mrpt_sgraphs/mapping/map_cloud.h"
#include "run_report.h"

namespace mrpt_sgraphs {
namespace {

template <typename Write>
void writeFile(const std::string& path, const Write& write) {
  AtomicFile file(path);
  write(file.stream());
  file.commit();
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

}  // namespace

void requireWritableFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error("cannot make the folder '" + folder + "': " + error.message());
  }
  AtomicFile((std::filesystem::path(folder) / "report.json").string());  // not committed
}

void writeRun(const std::string& folder, const RunRecord& run) {
  requireWritableFolder(folder);
  const auto in = [&folder](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  writeTum(in("trajectory.tum"), run.trajectory);
  writeTum(in("odometry.tum"), run.odometry);
  writeTum(in("keyframes.tum"), keyframeTrajectory(*run.graph));
  writeFile(in("graph.json"), [&](std::ostream& out) { writeGraphJson(*run.graph, out); });
  writeFile(in("graph.g2o"), [&](std::ostream& out) { writeG2o(*run.graph, out); });
  writeFile(in("map.pcd"), [&](std::ostream& out) {
    writePcd(*mapCloud(*run.graph, run.map_resolution_m), out);
  });
  writeMapFiles(folder, *run.graph, run.map);
  writeFile(in("optimizations.csv"),
            [&](std::ostream& out) { writeOptimizations(run.optimizations, out); });
  writeFile(in("scans.csv"), [&](std::ostream& out) { writeScans(run.scans, out); });
  writeFile(in("report.json"), [&](std::ostream& out) { writeReport(run, out); });
}

}  // namespace mrpt_sgraphs
