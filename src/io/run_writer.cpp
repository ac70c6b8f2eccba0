// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/run_writer.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <map>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "mrpt_sgraphs/mapping/map_cloud.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;

template <typename Write>
void writeFile(const std::string& path, const Write& write) {
  AtomicFile file(path);
  write(file.stream());
  file.commit();
}

void writeOptimizations(const std::vector<OptimizationSummary>& rows, std::ostream& out) {
  out << "stamp,kind,mode,keyframes_active,keyframes_marginalized,walls,rooms,floors,factors,"
         "free_variables,iterations,cost_before,cost_after,converged,total_ms,linearize_ms,"
         "factorize_ms\n";
  for (const OptimizationSummary& r : rows) {
    out << std::fixed << std::setprecision(6) << r.stamp_s << ',' << r.kind << ',' << r.mode << ','
        << r.keyframes_active << ',' << r.keyframes_marginalized << ',' << r.walls << ','
        << r.rooms << ',' << r.floors << ',' << r.factors << ',' << r.free_variables << ','
        << r.iterations << ',' << r.cost_before << ',' << r.cost_after << ','
        << (r.converged ? 1 : 0) << ',' << std::setprecision(3) << r.total_ms << ','
        << r.linearize_ms << ',' << r.factorize_ms << '\n';
  }
}

void writeScans(const std::vector<ScanReport>& rows, std::ostream& out) {
  out << "stamp,prefilter_ms,deskew_ms,register_ms,map_ms,segment_ms,keyframe_ms,rooms_ms,registered,keyframe\n";
  for (const ScanReport& r : rows) {
    out << std::fixed << std::setprecision(6) << r.stamp_s << std::setprecision(3) << ','
        << r.prefilter_ms << ',' << r.deskew_ms << ',' << r.register_ms << ',' << r.map_ms << ','
        << r.segment_ms << ',' << r.keyframe_ms << ',' << r.rooms_ms << ',' << (r.registered ? 1 : 0) << ',' << (r.keyframe ? 1 : 0) << '\n';
  }
}

Json timesOf(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {{"count", values.size()},
          {"mean_ms", sum / static_cast<double>(values.size())},
          {"p50_ms", quantile(values, 0.50)},
          {"p95_ms", quantile(values, 0.95)},
          {"max_ms", *std::max_element(values.begin(), values.end())}};
}

double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void writeReport(const RunRecord& run, std::ostream& out) {
  std::map<std::string, std::vector<double>> by_kind;
  for (const OptimizationSummary& r : run.optimizations) by_kind[r.kind].push_back(r.total_ms);
  Json optimizations = Json::object();
  for (const auto& [kind, times] : by_kind) optimizations[kind] = timesOf(times);

  std::vector<double> front_end;
  std::size_t registered = 0;
  for (const ScanReport& r : run.scans) {
    front_end.push_back(r.prefilter_ms + r.deskew_ms + r.register_ms + r.map_ms);
    registered += r.registered ? 1 : 0;
  }
  const auto loops =
      std::count_if(run.graph->factors.begin(), run.graph->factors.end(), [](const auto& stored) {
        const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
        return edge != nullptr && edge->kind == RelativePoseFactor::Kind::kLoopClosure;
      });
  const Json report = {
      {"format", "mrpt_sgraphs/report"},
      {"version", 1},
      {"scans", run.scans.size()},
      {"scans_registered", registered},
      {"keyframes", run.graph->keyframes.size()},
      {"loop_closures", loops},
      {"front_end_ms", timesOf(front_end)},
      {"optimizations", optimizations},
      {"data_s", run.data_s},
      {"wall_s", run.wall_s},
      {"real_time_factor", run.wall_s > 0.0 ? Json(run.data_s / run.wall_s) : Json(nullptr)},
      {"peak_mib", peakMebibytes()},
      {"parameters", run.parameters}};
  out << report.dump(1) << '\n';
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
  writeFile(in("optimizations.csv"),
            [&](std::ostream& out) { writeOptimizations(run.optimizations, out); });
  writeFile(in("scans.csv"), [&](std::ostream& out) { writeScans(run.scans, out); });
  writeFile(in("report.json"), [&](std::ostream& out) { writeReport(run, out); });
}

}  // namespace mrpt_sgraphs
