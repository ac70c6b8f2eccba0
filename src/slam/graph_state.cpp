// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/slam/graph_state.h"

#include <algorithm>
#include <map>

namespace mrpt_sgraphs {

void writeGraphState(GraphSlam* graph_slam, RunLog* log, StateWriter* state) {
  state->add("graph", [&](auto& a) {
    a("graph_slam", *graph_slam);
    a("log", *log);
  });
}

void readGraphState(const StateReader& state, GraphSlam* graph_slam, RunLog* log) {
  state.read("graph", [&](auto& a) {
    a("graph_slam", *graph_slam);
    a("log", *log);
  });
}

bool goesOnFrom(const GraphSnapshot& later, const GraphSnapshot& earlier) {
  if (earlier.keyframes.empty()) return false;
  const KeyframeNode& newest = earlier.keyframes.back();
  return std::any_of(later.keyframes.begin(), later.keyframes.end(),
                     [&newest](const KeyframeNode& keyframe) {
                       return keyframe.stamp_s == newest.stamp_s &&
                              keyframe.T_odom_base.matrix() == newest.T_odom_base.matrix();
                     });
}

std::vector<Keyframe> keyframesAfter(double stamp_s, const GraphSnapshot& graph) {
  std::map<NodeId, Matrix6> covariances;  // of the way to each
  const auto take = [&covariances](const Factor& factor) {
    const RelativePoseFactor* const edge = keyframeEdge(factor);
    if (edge == nullptr || edge->kind != RelativePoseFactor::Kind::kOdometry) return;
    covariances[edge->node(1)] = edge->information().inverse();
  };
  for (const StoredFactor& stored : graph.factors) take(*stored.factor);
  for (const ShelvedFactor& shelved : graph.shelved) take(*shelved.factor);

  std::vector<Keyframe> keyframes;
  for (const KeyframeNode& node : graph.keyframes) {
    const auto covariance = covariances.find(node.id);
    if (node.stamp_s <= stamp_s || node.cloud == nullptr || covariance == covariances.end()) continue;
    keyframes.push_back(
        {node.stamp_s, node.T_odom_base, covariance->second, node.cloud, node.planes});
  }
  return keyframes;
}

}  // namespace mrpt_sgraphs
