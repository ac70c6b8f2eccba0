// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "stages.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/geometry/cpu_time.h"

namespace mrpt_sgraphs {
namespace {

// What is optimized again with the next keyframe, or the next loop, need not be to the last digit now:
// an iteration that promises less than this share of the cost is the last one.
constexpr double kLocalDecrease = 0.05;
constexpr double kGlobalDecrease = 1e-4;

/// "keyframe 7 and 3 more nodes may move in 6 directions that no factor holds"
std::string sentence(const GaugeFreedom& freedom) {
  std::string text = nameOf(freedom.nodes.empty() ? freedom.held : freedom.nodes.front());
  if (freedom.nodes.size() > 1) {
    text += " and " + std::to_string(freedom.nodes.size() - 1) + " more nodes";
  }
  return text + " may move in " + std::to_string(freedom.dimensions) +
         " directions that no factor holds";
}

KeyframeRuns keyframesOf(const std::vector<NodeId>& nodes) {
  KeyframeRuns keyframes;
  for (const NodeId node : nodes) {
    if (node.layer == Layer::kKeyframe) keyframes.add(KeyframeId{node.value});
  }
  return keyframes;
}

void follow(LayeredGraph* graph) {
  const auto keyframes = static_cast<uint32_t>(graph->size(Layer::kKeyframe));
  if (keyframes == 0) return;
  const NodeHandle newest{Layer::kKeyframe, keyframes - 1};
  const KeyframeAttributes& attributes = graph->attributes(KeyframeId{graph->nodeAt(newest).value});
  graph->setMapOdom(orthonormalized(graph->pose(newest) * attributes.T_odom_base.inverse()));
}

}  // namespace

Stages::Stages(const HierarchyConfig& hierarchy, const OptimizerConfig& optimizer)
    : hierarchy_(hierarchy),
      optimizer_config_(optimizer),
      window_(static_cast<std::size_t>(hierarchy.local_keyframes)),
      compression_(hierarchy) {
  const auto& modes = HierarchyConfig::kModes;
  if (std::find(modes.begin(), modes.end(), hierarchy.mode) == modes.end()) {
    throw std::invalid_argument("there is no mode '" + hierarchy.mode + "'");
  }
  optimizer_config_.max_time_s = 1e-3 * hierarchy.budget_ms;
}

OptimizationSummary Stages::local(LayeredGraph* graph) {
  if (!compresses()) return optimize("full", selectAll(*graph), 0.0, graph);
  compression_.mend(graph);
  return optimize("local", window_.select(*graph), kLocalDecrease, graph);
}

OptimizationSummary Stages::room(RoomId room, LayeredGraph* graph) {
  if (!compresses()) return optimize("full", selectAll(*graph), 0.0, graph);
  compression_.mend(graph);
  const OptimizationSummary summary = optimizeRoom(room, graph);
  optimized_room_ = room;
  optimized_at_ = graph->size(Layer::kKeyframe);
  return summary;
}

OptimizationSummary Stages::global(const std::optional<FloorId>& storey, LayeredGraph* graph) {
  if (!compresses()) return optimize("full", selectAll(*graph), 0.0, graph);
  compression_.mend(graph);
  const OptimizationSummary summary =
      storey ? optimize("floor_local", selectFloor(*graph, *storey), kGlobalDecrease, graph)
             : optimize("global", selectAll(*graph), kGlobalDecrease, graph);
  window_.forget();
  return summary;
}

void Stages::compress(bool changed, LayeredGraph* graph, Summaries* summaries) {
  if (!compresses()) return;
  compression_.mend(graph);
  const auto start = std::chrono::steady_clock::now();
  CpuStopwatch watch;
  for (const RegionPlan& plan : compression_.due(*graph, changed)) {
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - start;
    if (hierarchy_.budget_ms > 0.0 && spent.count() > hierarchy_.budget_ms) break;
    if (plan.room && !(optimized_room_ == plan.room && optimized_at_ == graph->size(Layer::kKeyframe))) {
      summaries->push_back(optimizeRoom(*plan.room, graph));
      watch.lap();
    }
    summaries->push_back(condense(plan, graph));
    summaries->back().total_ms = watch.lap();
  }
}

OptimizationSummary Stages::optimizeRoom(RoomId room, LayeredGraph* graph) {
  OptimizationSummary summary =
      optimize("room_local", selectRoom(*graph, room), kLocalDecrease, graph);
  window_.forget();  // what lies behind it may have moved
  summary.room = room;
  return summary;
}

OptimizationSummary Stages::condense(const RegionPlan& plan, LayeredGraph* graph) {
  const std::size_t dropped_before = compression_.followers().count();
  compression_.apply(plan, graph);
  OptimizationSummary summary = begun("condense", *graph);
  summary.room = plan.room;
  summary.dropped = summary.keyframes_marginalized - static_cast<int>(dropped_before);
  summary.free_variables = 6 * static_cast<int>(plan.dropped.size());
  summary.converged = true;
  return summary;
}

void Stages::finish(LayeredGraph* graph, Summaries* summaries) {
  if (!compresses()) return;
  compression_.mend(graph);
  summaries->push_back(
      optimize("global", selectAll(*graph), optimizer_config_.min_relative_decrease, graph));
  window_.forget();
  compression_.followers().placeAll(graph);
  if (hierarchy_.mode != "condensed") return;
  OptimizationSummary summary = begun("resolve", *graph);
  summary.converged = true;
  summary.total_ms = compression_.resolve(optimizer_config_, graph);
  summaries->push_back(summary);
}

OptimizationSummary Stages::begun(const char* kind, const LayeredGraph& graph) const {
  OptimizationSummary summary;
  summary.kind = kind;
  summary.mode = hierarchy_.mode;
  const std::size_t keyframes = graph.size(Layer::kKeyframe);
  const std::size_t dropped = compression_.followers().count();
  summary.keyframes_marginalized = static_cast<int>(dropped);
  summary.keyframes_active = static_cast<int>(keyframes - dropped);
  summary.walls = static_cast<int>(graph.size(Layer::kWall));
  summary.rooms = static_cast<int>(graph.size(Layer::kRoom));
  summary.floors = static_cast<int>(graph.size(Layer::kFloor));
  summary.factors = static_cast<int>(graph.factorCount());
  if (keyframes > 0) {
    const NodeHandle newest{Layer::kKeyframe, static_cast<uint32_t>(keyframes - 1)};
    summary.stamp_s = graph.attributes(KeyframeId{graph.nodeAt(newest).value}).stamp_s;
  }
  return summary;
}

OptimizationSummary Stages::optimize(const char* kind, const Selection& selection,
                                     double min_relative_decrease, LayeredGraph* graph) {
  CpuStopwatch watch;
  OptimizerConfig config = optimizer_config_;
  config.min_relative_decrease = std::max(config.min_relative_decrease, min_relative_decrease);
  const OptimizerReport report =
      compression_.followers().optimize(selection, config, &optimizer_, graph);
  follow(graph);
  OptimizationSummary summary = begun(kind, *graph);
  summary.factors = report.factors;
  summary.free_variables = report.free_tangents;
  summary.free_keyframes = keyframesOf(selection.free);
  summary.fixed_keyframes = keyframesOf(selection.fixed);
  summary.iterations = report.iterations;
  summary.cost_before = report.cost_before;
  summary.cost_after = report.cost_after;
  // where the answer is one of many there is nothing to converge to
  summary.converged = report.converged && report.gauge.empty();
  summary.problem = report.problem;
  if (report.problem.empty() && !report.gauge.empty()) {
    summary.problem = sentence(report.gauge.front());
  }
  summary.total_ms = watch.lap();  // the problem has to be made as well
  summary.linearize_ms = report.linearize_ms;
  summary.factorize_ms = report.factorize_ms;
  return summary;
}

}  // namespace mrpt_sgraphs
