// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_feed.h"

#include <algorithm>

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kNewestOnly = 1;
constexpr std::uint32_t kQueueSize = 100;

}  // namespace

GraphFeed::GraphFeed(const std::string& name_space) : nh_(name_space) {
  nh_.setCallbackQueue(&queue_);
  graph_sub_ = nh_.subscribe("graph", kNewestOnly, &GraphFeed::onGraph, this);
  optimization_sub_ = nh_.subscribe("optimization", kQueueSize, &GraphFeed::onOptimization, this);
  parameters_sub_ =
      nh_.subscribe("hierarchy/parameter_updates", kQueueSize, &GraphFeed::onParameters, this);
  spinner_.start();
}

GraphFeed::State GraphFeed::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_;
}

void GraphFeed::onGraph(const SituationalGraph& msg) {
  const auto dropped = static_cast<std::size_t>(
      std::count_if(msg.keyframes.begin(), msg.keyframes.end(),
                    [](const GraphKeyframe& keyframe) { return keyframe.marginalized != 0; }));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (msg.session != session_) state_.log = OptimizationLog();  // a map begins anew
  session_ = msg.session;
  state_.sizes = Sizes{msg.keyframes.size() - dropped,
                       dropped,
                       msg.walls.size(),
                       msg.rooms.size(),
                       msg.floors.size(),
                       msg.factors.size()};
}

void GraphFeed::onOptimization(const OptimizationReport& msg) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.log.add(msg.kind, msg.total_ms);
  state_.last_problem = msg.problem;
}

void GraphFeed::onParameters(const dynamic_reconfigure::Config& msg) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& parameter : msg.strs) {
    if (parameter.name == "mode") state_.mode = parameter.value;
  }
}

}  // namespace mrpt_sgraphs
