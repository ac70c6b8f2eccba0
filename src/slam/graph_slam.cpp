// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_slam.h"

#include <map>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/graph/situational_graph.h"

namespace mrpt_sgraphs {

struct GraphSlam::State {
  State(const LoopCloserConfig& loops, const PoseGraphOptimizerConfig& solver)
      : loop_closer(loops), solver(solver) {}

  SituationalGraph graph;
  LoopCloser loop_closer;
  PoseGraphOptimizerConfig solver;
};

GraphSlam::GraphSlam(const LoopCloserConfig& loops, const PoseGraphOptimizerConfig& solver)
    : state_(std::make_unique<State>(loops, solver)) {}

GraphSlam::~GraphSlam() = default;

KeyframeOutcome GraphSlam::addKeyframe(const Keyframe& keyframe) {
  using Kind = RelativePoseFactor::Kind;
  if (keyframe.cloud == nullptr || keyframe.cloud->empty()) {
    throw std::invalid_argument("a keyframe needs a cloud");
  }
  SituationalGraph& graph = state_->graph;
  const GraphSnapshotConstPtr before = graph.snapshot();
  if (!before->keyframes.empty() && keyframe.stamp_s <= before->stamp_s) {
    throw std::invalid_argument("a keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s is not newer than the last one of " +
                                std::to_string(before->stamp_s) + " s");
  }

  KeyframeAttributes attributes;
  attributes.stamp_s = keyframe.stamp_s;
  attributes.T_odom_base = keyframe.T_odom_base;
  attributes.cloud = keyframe.cloud;
  KeyframeOutcome outcome;
  outcome.id = graph.addKeyframe(graph.T_map_odom() * keyframe.T_odom_base, attributes);
  if (!before->keyframes.empty()) {
    const KeyframeNode& last = before->keyframes.back();
    graph.addFactor(std::make_shared<RelativePoseFactor>(
        last.id, outcome.id, last.T_odom_base.inverse() * keyframe.T_odom_base,
        keyframe.covariance.inverse(), Kind::kOdometry));
  }

  const RobustKernel doubt{RobustKernel::Kind::kCauchy, state_->solver.loop_kernel_chi2};
  for (const LoopClosure& loop : state_->loop_closer.find(*graph.snapshot())) {
    graph.addFactor(std::make_shared<RelativePoseFactor>(
        loop.from, loop.to, loop.T_from_to, loop.information, Kind::kLoopClosure, doubt));
    ++outcome.loop_closures;
  }
  if (outcome.loop_closures > 0) outcome.optimization = optimize();
  return outcome;
}

OptimizationSummary GraphSlam::optimize() {
  SituationalGraph& graph = state_->graph;
  const GraphSnapshotConstPtr now = graph.snapshot();
  std::map<KeyframeId, Pose> poses;
  for (const KeyframeNode& keyframe : now->keyframes) poses[keyframe.id] = keyframe.T_map_base;
  std::vector<RelativePoseEdge> edges;
  for (const StoredFactor& stored : now->factors) {
    const RelativePoseFactor* const factor = keyframeEdge(*stored.factor);
    if (factor == nullptr) continue;
    RelativePoseEdge edge;
    edge.from = KeyframeId{factor->node(0).value};
    edge.to = KeyframeId{factor->node(1).value};
    edge.T_from_to = factor->T_from_to;
    edge.information = factor->information();
    if (factor->kind == RelativePoseFactor::Kind::kLoopClosure) {
      edge.kind = RelativePoseEdge::Kind::kLoopClosure;
    }
    edges.push_back(edge);
  }

  OptimizationSummary summary = optimizePoseGraph(edges, state_->solver, &poses);
  for (const auto& [id, T_map_base] : poses) graph.setPose(id, T_map_base);
  if (!poses.empty()) {
    const KeyframeNode& newest = now->keyframes.back();
    graph.setMapOdom(orthonormalized(graph.pose(newest.id) * newest.T_odom_base.inverse()));
    summary.stamp_s = newest.stamp_s;
  }
  return summary;
}

GraphSnapshotConstPtr GraphSlam::snapshot() const { return state_->graph.snapshot(); }

const Pose& GraphSlam::T_map_odom() const { return state_->graph.T_map_odom(); }

}  // namespace mrpt_sgraphs
