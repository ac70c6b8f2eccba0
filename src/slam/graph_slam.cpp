// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_slam.h"

#include <Eigen/Cholesky>
#include <limits>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/frontend/ground_layer.h"
#include "mrpt_sgraphs/frontend/wall_layer.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/semantics/floor_layer.h"
#include "mrpt_sgraphs/semantics/room_layer.h"
#include "mrpt_sgraphs/semantics/room_reunion.h"

namespace mrpt_sgraphs {
namespace {

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

OptimizationSummary summaryOf(const OptimizerReport& report, const Selection& selection,
                              const LayeredGraph& graph) {
  OptimizationSummary summary;
  summary.kind = "full";
  summary.mode = "baseline";
  for (uint32_t slot = 0; slot < graph.size(Layer::kKeyframe); ++slot) {
    const KeyframeId id{graph.nodeAt({Layer::kKeyframe, slot}).value};
    ++(graph.attributes(id).marginalized ? summary.keyframes_marginalized
                                         : summary.keyframes_active);
  }
  summary.walls = static_cast<int>(graph.size(Layer::kWall));
  summary.rooms = static_cast<int>(graph.size(Layer::kRoom));
  summary.floors = static_cast<int>(graph.size(Layer::kFloor));
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
  summary.total_ms = report.total_ms;
  summary.linearize_ms = report.linearize_ms;
  summary.factorize_ms = report.factorize_ms;
  return summary;
}

}  // namespace

struct GraphSlam::State {
  explicit State(const GraphSlamConfig& config)
      : config(config),
        loop_closer(config.loop_closure),
        walls(config.walls),
        ground(config.ground),
        rooms(config.rooms) {}

  bool associate();
  void addLoop(const LoopClosure& loop);
  bool reuniteRooms();
  OptimizationSummary optimizeOnce();
  void settle(bool after_loop, std::vector<OptimizationSummary>* optimizations);

  GraphSlamConfig config;
  LayeredGraph graph;
  LoopCloser loop_closer;
  WayToNewest way;
  WallLayer walls;
  GroundLayer ground;
  RoomLayer rooms;
  double reunion_tried_at_m = -std::numeric_limits<double>::infinity();
  Optimizer optimizer;
};

/// The planes of the newest keyframe.
/// @return Whether the graph has new factors.
bool GraphSlam::State::associate() {
  if (!config.walls.enabled && !config.ground.enabled) return false;
  way.update(graph);
  const bool grounded = config.ground.enabled && ground.associate(way, &graph);
  const bool walled = config.walls.enabled && walls.associate(way, &graph);
  return grounded || walled;
}

void GraphSlam::State::addLoop(const LoopClosure& loop) {
  const RobustKernel doubt{RobustKernel::Kind::kCauchy, config.solver.loop_kernel_chi2};
  graph.addFactor(
      std::make_shared<RelativePoseFactor>(loop.from, loop.to, loop.T_from_to, loop.information,
                                           RelativePoseFactor::Kind::kLoopClosure, doubt));
}

/// Closes a loop if the newest keyframe is in a room that the map has twice.
bool GraphSlam::State::reuniteRooms() {
  if (!config.rooms.close_loops || !config.loop_closure.enabled) return false;
  if (graph.size(Layer::kRoom) < 2) return false;
  // rooms that look alike are many: as often as loops are looked for, not at every keyframe
  if (way.way_m() - reunion_tried_at_m < config.loop_closure.min_interval_m) return false;
  const GraphSnapshotConstPtr now = graph.snapshot();
  const auto reunion = findReunion(*now, config.loop_closure.max_chi2);
  if (!reunion) return false;
  reunion_tried_at_m = way.way_m();
  const auto loop = loop_closer.confirm(*now, reunion->keyframe, reunion->T_keyframe_newest);
  if (loop) addLoop(*loop);
  return loop.has_value();
}

OptimizationSummary GraphSlam::State::optimizeOnce() {
  const Selection selection = selectAll(graph);
  const OptimizerReport report =
      optimizeSelection(selection, config.solver.optimizer, &optimizer, &graph);
  const uint32_t keyframes = static_cast<uint32_t>(graph.size(Layer::kKeyframe));
  OptimizationSummary summary = summaryOf(report, selection, graph);
  if (keyframes > 0) {
    const NodeHandle newest{Layer::kKeyframe, keyframes - 1};
    const KeyframeAttributes& attributes = graph.attributes(KeyframeId{graph.nodeAt(newest).value});
    summary.stamp_s = attributes.stamp_s;
    graph.setMapOdom(orthonormalized(graph.pose(newest) * attributes.T_odom_base.inverse()));
  }
  return summary;
}

/// Optimizes until the walls stay what they are.
void GraphSlam::State::settle(bool after_loop, std::vector<OptimizationSummary>* optimizations) {
  // Each round but the first is for walls that were merged or split in the one before; what is left
  // then waits for the next keyframe.
  constexpr int kMaxRounds = 3;
  if (after_loop && config.walls.enabled) walls.release(&graph);
  for (int round = 0; round < kMaxRounds; ++round) {
    rooms.mend(&graph);
    optimizations->push_back(optimizeOnce());
    rooms.follow(&graph);
    if (!config.walls.enabled || graph.size(Layer::kKeyframe) == 0) return;
    const bool widened = after_loop && round == 0;
    if (widened) way.update(graph);
    const bool changed =
        widened ? walls.maintainAfterLoop(way, &graph) : walls.maintain(way, &graph);
    if (!changed) return;
  }
}

GraphSlam::GraphSlam(const GraphSlamConfig& config) : state_(std::make_unique<State>(config)) {}

GraphSlam::~GraphSlam() = default;

KeyframeOutcome GraphSlam::addKeyframe(const Keyframe& keyframe) {
  using Kind = RelativePoseFactor::Kind;
  if (keyframe.cloud == nullptr || keyframe.cloud->empty()) {
    throw std::invalid_argument("a keyframe needs a cloud");
  }
  LayeredGraph& graph = state_->graph;
  const GraphSnapshotConstPtr before = graph.snapshot();
  if (!before->keyframes.empty() && keyframe.stamp_s <= before->stamp_s) {
    throw std::invalid_argument("a keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s is not newer than the last one of " +
                                std::to_string(before->stamp_s) + " s");
  }

  const bool known =
      keyframe.covariance.allFinite() && keyframe.covariance.llt().info() == Eigen::Success;
  if (!before->keyframes.empty() && !known) {
    throw std::invalid_argument("the covariance of a keyframe is not positive definite");
  }

  KeyframeAttributes attributes;
  attributes.stamp_s = keyframe.stamp_s;
  attributes.T_odom_base = keyframe.T_odom_base;
  attributes.cloud = keyframe.cloud;
  attributes.planes = keyframe.planes;
  KeyframeOutcome outcome;
  outcome.id = graph.addKeyframe(graph.T_map_odom() * keyframe.T_odom_base, attributes);
  if (!before->keyframes.empty()) {
    const KeyframeNode& last = before->keyframes.back();
    graph.addFactor(std::make_shared<RelativePoseFactor>(
        last.id, outcome.id, last.T_odom_base.inverse() * keyframe.T_odom_base,
        keyframe.covariance.inverse(), Kind::kOdometry));
  }

  const bool has_surfaces = state_->associate();
  for (const LoopClosure& loop : state_->loop_closer.find(*graph.snapshot())) {
    state_->addLoop(loop);
    ++outcome.loop_closures;
  }
  const bool has_loops = outcome.loop_closures > 0;
  if (has_surfaces || has_loops) state_->settle(has_loops, &outcome.optimizations);
  return outcome;
}

std::vector<OptimizationSummary> GraphSlam::setFloors(const FloorDetection& detection) {
  std::vector<OptimizationSummary> optimizations;
  if (updateFloors(detection, &state_->ground, &state_->graph)) {
    state_->settle(false, &optimizations);
  }
  return optimizations;
}

std::vector<OptimizationSummary> GraphSlam::setRooms(const RoomDetection& detection) {
  std::vector<OptimizationSummary> optimizations;
  if (state_->rooms.update(detection, &state_->graph)) state_->settle(false, &optimizations);
  if (state_->reuniteRooms()) state_->settle(true, &optimizations);
  return optimizations;
}

OptimizationSummary GraphSlam::optimize() {
  std::vector<OptimizationSummary> optimizations;
  state_->settle(false, &optimizations);
  return optimizations.back();
}

void GraphSlam::setHierarchy(const HierarchyConfig& hierarchy) {
  state_->config.hierarchy = hierarchy;
}

GraphSnapshotConstPtr GraphSlam::snapshot() const { return state_->graph.snapshot(); }

const Pose& GraphSlam::T_map_odom() const { return state_->graph.T_map_odom(); }

}  // namespace mrpt_sgraphs
