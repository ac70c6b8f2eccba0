// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/followers.h"

#include <algorithm>
#include <utility>

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"

namespace mrpt_sgraphs {

std::vector<KeyframeId> Followers::take(KeyframeId kept) {
  const auto found = of_.find(kept);
  if (found == of_.end()) return {};
  std::vector<KeyframeId> taken = std::move(found->second);
  of_.erase(found);
  return taken;
}

std::size_t Followers::count() const {
  std::size_t count = 0;
  for (const auto& [kept, dropped] : of_) count += dropped.size();
  return count;
}

OptimizerReport Followers::optimize(const Selection& selection, const OptimizerConfig& config,
                                    Optimizer* optimizer, LayeredGraph* graph) const {
  std::vector<std::pair<const std::vector<KeyframeId>*, Pose>> before;
  std::vector<KeyframeId> leaders;
  for (const NodeId node : selection.free) {
    if (node.layer != Layer::kKeyframe) continue;
    const auto found = of_.find(KeyframeId{node.value});
    if (found == of_.end()) continue;
    leaders.push_back(found->first);
    before.emplace_back(&found->second, graph->pose(found->first));
  }
  const OptimizerReport report = optimizeSelection(selection, config, optimizer, graph);
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    const auto& [followers, was] = before[k];
    const Pose now = graph->pose(leaders[k]);
    if (now.matrix() == was.matrix()) continue;
    const Pose motion = now * was.inverse();
    for (const KeyframeId id : *followers) {
      graph->setPose(id, orthonormalized(motion * graph->pose(id)));
    }
  }
  return report;
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
