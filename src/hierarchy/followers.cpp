// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/followers.h"

#include <algorithm>
#include <utility>

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"

namespace mrpt_sgraphs {

namespace {

bool hasMoved(const Pose& from, const Pose& to) {
  constexpr double kNothing_m = 1e-3;
  constexpr double kNothing_rad = 2e-4;  // a millimetre across a room
  const Tangent motion = local(from, to);
  return motion.head<3>().norm() > kNothing_m || motion.tail<3>().norm() > kNothing_rad;
}

}  // namespace

void Followers::add(KeyframeId kept, const Pose& T_map_kept, KeyframeId dropped) {
  Group& group = of_[kept];
  if (group.dropped.empty()) group.T_map_kept = T_map_kept;
  group.dropped.push_back(dropped);
  ++count_;
}

std::vector<KeyframeId> Followers::take(KeyframeId kept) {
  const auto found = of_.find(kept);
  if (found == of_.end()) return {};
  std::vector<KeyframeId> taken = std::move(found->second.dropped);
  of_.erase(found);
  count_ -= taken.size();
  return taken;
}

void Followers::clear() {
  of_.clear();
  count_ = 0;
}

OptimizerReport Followers::optimize(const Selection& selection, const OptimizerConfig& config,
                                    Optimizer* optimizer, LayeredGraph* graph) {
  const OptimizerReport report = optimizeSelection(selection, config, optimizer, graph);
  for (const NodeId node : selection.free) {
    if (node.layer != Layer::kKeyframe) continue;
    const auto found = of_.find(KeyframeId{node.value});
    if (found == of_.end()) continue;
    if (hasMoved(found->second.T_map_kept, graph->pose(found->first))) {
      place(found->first, &found->second, graph);
    }
  }
  return report;
}

void Followers::place(KeyframeId kept, LayeredGraph* graph) {
  const auto found = of_.find(kept);
  if (found != of_.end()) place(kept, &found->second, graph);
}

void Followers::placeAll(LayeredGraph* graph) {
  for (auto& [kept, group] : of_) place(kept, &group, graph);
}

void Followers::place(KeyframeId kept, Group* group, LayeredGraph* graph) {
  const Pose now = graph->pose(kept);
  if (now.matrix() == group->T_map_kept.matrix()) return;
  const Pose motion = now * group->T_map_kept.inverse();
  for (const KeyframeId id : group->dropped) {
    graph->setPose(id, orthonormalized(motion * graph->pose(id)));
  }
  group->T_map_kept = now;
}

double resolveDropped(KeyframeId kept, const OptimizerConfig& config, LayeredGraph* graph) {
  std::vector<FactorId> ids = graph->shelf().keptBy(kept);
  std::sort(ids.begin(), ids.end());
  std::vector<FactorConstPtr> factors;
  for (const FactorId id : ids) factors.push_back(graph->factor(id));
  const auto is_dropped = [graph](NodeId node) {
    return node.layer == Layer::kKeyframe &&
           graph->attributes(KeyframeId{node.value}).marginalized;
  };
  return optimizeUnder(factors, is_dropped, config, graph).total_ms;
}

}  // namespace mrpt_sgraphs
