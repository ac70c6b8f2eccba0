// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "run_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;

Json timesOf(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  return {{"count", values.size()},
          {"mean_ms", mean(values)},
          {"p50_ms", quantile(values, 0.50)},
          {"p95_ms", quantile(values, 0.95)},
          {"max_ms", quantile(values, 1.0)},
          {"total_ms", std::accumulate(values.begin(), values.end(), 0.0)}};
}

Json optimizationTimes(const std::vector<OptimizationSummary>& optimizations) {
  std::map<std::string, std::vector<double>> by_kind;
  for (const OptimizationSummary& o : optimizations) by_kind[o.kind].push_back(o.total_ms);
  Json times = Json::object();
  for (const auto& [kind, values] : by_kind) times[kind] = timesOf(values);
  return times;
}

Json frontEndTimes(const std::vector<ScanReport>& scans) {
  std::vector<double> times;
  for (const ScanReport& r : scans) {
    times.push_back(r.prefilter_ms + r.deskew_ms + r.register_ms + r.map_ms);
  }
  return timesOf(times);
}

/// Of keyframes, with everything in it: nothing that is done now and then is left out of the means.
Json backEndTimes(const std::vector<ScanReport>& scans) {
  std::vector<double> all;
  std::vector<double> graph;
  std::vector<double> rooms;
  for (const ScanReport& r : scans) {
    if (!r.keyframe) continue;
    all.push_back(r.keyframe_ms + r.rooms_ms);
    graph.push_back(r.keyframe_ms);
    rooms.push_back(r.rooms_ms);
  }
  return {{"all", timesOf(all)}, {"graph", timesOf(graph)}, {"room_detection", timesOf(rooms)}};
}

std::size_t loopClosures(const GraphSnapshot& graph) {
  const auto isLoop = [](const Factor& factor) {
    const RelativePoseFactor* const edge = keyframeEdge(factor);
    return edge != nullptr && edge->kind == RelativePoseFactor::Kind::kLoopClosure;
  };
  return static_cast<std::size_t>(
      std::count_if(graph.factors.begin(), graph.factors.end(),
                    [&](const StoredFactor& stored) { return isLoop(*stored.factor); }));
}

/// How many keyframes are in one place, and which of them take part in the optimization.
struct Occupancy {
  std::size_t keyframes = 0;
  std::vector<std::uint64_t> kept;
};

Json toJson(const Occupancy& place) {
  return {{"keyframes", place.keyframes},
          {"dropped", place.keyframes - place.kept.size()},
          {"kept", place.kept}};
}

/// By room; without one: in none that is in the graph.
std::map<std::optional<RoomId>, Occupancy> occupancies(const GraphSnapshot& graph) {
  std::map<std::optional<RoomId>, Occupancy> places;
  places[std::nullopt];
  for (const RoomNode& room : graph.rooms) places[room.id];
  for (const KeyframeNode& keyframe : graph.keyframes) {
    const auto room = places.find(keyframe.room);
    Occupancy& place = room == places.end() ? places[std::nullopt] : room->second;
    ++place.keyframes;
    if (!keyframe.marginalized) place.kept.push_back(keyframe.id.value);
  }
  return places;
}

Json describe(const GraphSnapshot& graph) {
  const auto places = occupancies(graph);
  Json rooms = Json::array();
  for (const RoomNode& room : graph.rooms) {
    Json line = toJson(places.at(room.id));
    line["id"] = room.id.value;
    line["name"] = room.name;
    line["kind"] = nameOf(room.kind);
    rooms.push_back(line);
  }
  std::size_t active = 0;
  for (const auto& [room, place] : places) active += place.kept.size();
  return {{"keyframes", graph.keyframes.size()},
          {"keyframes_active", active},
          {"keyframes_marginalized", graph.keyframes.size() - active},
          {"walls", graph.walls.size()},
          {"floors", graph.floors.size()},
          {"factors", graph.factors.size()},
          {"factors_shelved", graph.shelved.size()},
          {"loop_closures", loopClosures(graph)},
          {"rooms", rooms},
          {"in_no_room", toJson(places.at(std::nullopt))}};
}

Json describe(const LocalizationReport& report) {
  const auto orNull = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  return {{"localized", report.localized},
          {"problem", report.problem},
          {"first_after_s", orNull(report.first_after_s)},
          {"first_after_m", orNull(report.first_after_m)},
          {"relocations", report.relocations},
          {"losses", report.losses}};
}

double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

void writeReport(const RunRecord& run, std::ostream& out) {
  const auto registered = std::count_if(run.scans.begin(), run.scans.end(),
                                        [](const ScanReport& r) { return r.registered; });
  Json report = {
      {"format", "mrpt_sgraphs/report"},
      {"version", 1},
      {"scans", run.scans.size()},
      {"scans_registered", registered},
      {"front_end_ms", frontEndTimes(run.scans)},
      {"back_end_ms", backEndTimes(run.scans)},
      {"optimizations", optimizationTimes(run.optimizations)},
      {"data_s", run.data_s},
      {"wall_s", run.wall_s},
      {"real_time_factor", run.wall_s > 0.0 ? Json(run.data_s / run.wall_s) : Json(nullptr)},
      {"peak_mib", peakMebibytes()},
      {"parameters", run.parameters}};
  report.update(describe(*run.graph));
  if (run.localization) report["localization"] = describe(*run.localization);
  out << report.dump(1) << '\n';
}

}  // namespace mrpt_sgraphs
