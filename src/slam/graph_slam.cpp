// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_slam.h"

#include <stdexcept>

#include "mrpt_sgraphs/graph/keyframe_graph.h"

namespace mrpt_sgraphs {

GraphSlam::GraphSlam(const LoopCloserConfig& loops, const PoseGraphOptimizerConfig& solver)
    : graph_(std::make_unique<KeyframeGraph>()), loop_closer_(loops), solver_(solver) {}

GraphSlam::~GraphSlam() = default;

KeyframeOutcome GraphSlam::addKeyframe(const Keyframe& keyframe) {
  if (keyframe.cloud == nullptr || keyframe.cloud->empty()) {
    throw std::invalid_argument("a keyframe needs a cloud");
  }
  const bool is_first = graph_->size() == 0;
  std::optional<KeyframeNode> last;
  if (!is_first) last = graph_->node(graph_->ids().back());
  if (last && keyframe.stamp_s <= last->stamp_s) {
    throw std::invalid_argument("a keyframe of " + std::to_string(keyframe.stamp_s) +
                                " s is not newer than the last one of " +
                                std::to_string(last->stamp_s) + " s");
  }

  KeyframeOutcome outcome;
  outcome.id = graph_->add(keyframe.stamp_s, T_map_odom_ * keyframe.T_odom_base,
                           keyframe.T_odom_base, keyframe.cloud);
  if (last) {
    RelativePoseEdge edge;
    edge.from = last->id;
    edge.to = outcome.id;
    edge.T_from_to = last->T_odom_base.inverse() * keyframe.T_odom_base;
    edge.information = keyframe.covariance.inverse();
    graph_->add(edge);
  }
  snapshot_.reset();

  const GraphSnapshotConstPtr now = snapshot();
  for (const RelativePoseEdge& loop : loop_closer_.find(now->keyframes, now->edges)) {
    graph_->add(loop);
    ++outcome.loop_closures;
  }
  if (outcome.loop_closures > 0) outcome.optimization = optimize();
  return outcome;
}

OptimizationSummary GraphSlam::optimize() {
  std::map<KeyframeId, Pose> poses;
  for (const KeyframeId id : graph_->ids()) poses[id] = graph_->pose(id);
  std::vector<RelativePoseEdge> edges;
  for (std::size_t k = 0; k < graph_->edgeCount(); ++k) edges.push_back(graph_->edge(k));

  OptimizationSummary summary = optimizePoseGraph(edges, solver_, &poses);
  for (const auto& [id, T_map_base] : poses) graph_->setPose(id, T_map_base);
  if (!poses.empty()) {
    const KeyframeNode newest = graph_->node(poses.rbegin()->first);
    T_map_odom_ = orthonormalized(newest.T_map_base * newest.T_odom_base.inverse());
    summary.stamp_s = newest.stamp_s;
  }
  snapshot_.reset();
  return summary;
}

GraphSnapshotConstPtr GraphSlam::snapshot() const {
  if (snapshot_ == nullptr) {
    auto snapshot = std::make_shared<GraphSnapshot>();
    snapshot->T_map_odom = T_map_odom_;
    for (const KeyframeId id : graph_->ids()) snapshot->keyframes.push_back(graph_->node(id));
    for (std::size_t k = 0; k < graph_->edgeCount(); ++k) {
      snapshot->edges.push_back(graph_->edge(k));
    }
    if (!snapshot->keyframes.empty()) snapshot->stamp_s = snapshot->keyframes.back().stamp_s;
    snapshot_ = snapshot;
  }
  return snapshot_;
}

}  // namespace mrpt_sgraphs
