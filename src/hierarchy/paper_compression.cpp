// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "mrpt_sgraphs/hierarchy/compression.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes that hang together.
class Groups {
 public:
  KeyframeId of(KeyframeId id) {
    KeyframeId& parent = parent_.try_emplace(id, id).first->second;
    if (parent != id) parent = of(KeyframeId(parent));
    return parent;
  }
  /// @return False if they were in one group already.
  bool join(KeyframeId a, KeyframeId b) {
    const KeyframeId first = of(a);
    const KeyframeId second = of(b);
    if (first == second) return false;
    parent_[std::max(first, second)] = std::min(first, second);
    return true;
  }

 private:
  std::map<KeyframeId, KeyframeId> parent_;
};

/// Dropped keyframes that hang together, what remains around them and what was known between.
struct Gap {
  std::set<KeyframeId> neighbours;
  Matrix6 information = Matrix6::Zero();
};

void bridge(const Gap& gap, LayeredGraph* graph) {
  std::vector<std::tuple<double, KeyframeId, KeyframeId>> pairs;
  for (auto a = gap.neighbours.begin(); a != gap.neighbours.end(); ++a) {
    for (auto b = std::next(a); b != gap.neighbours.end(); ++b) {
      const double distance_m =
          (graph->pose(*a).translation() - graph->pose(*b).translation()).norm();
      pairs.emplace_back(distance_m, *a, *b);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  Groups joined;
  for (const auto& [distance_m, a, b] : pairs) {
    if (!joined.join(a, b)) continue;
    const Pose T_a_b = orthonormalized(graph->pose(a).inverse() * graph->pose(b));
    graph->addFactor(std::make_shared<RelativePoseFactor>(a, b, T_a_b, gap.information,
                                                          RelativePoseFactor::Kind::kBridge));
  }
}

}  // namespace

void marginalizeByTheLetter(KeyframeId kept, const std::vector<KeyframeId>& dropped,
                            LayeredGraph* graph) {
  const std::set<KeyframeId> is_dropped(dropped.begin(), dropped.end());
  std::set<FactorId> gone;
  Groups groups;
  for (const KeyframeId id : dropped) {
    groups.of(id);
    for (const FactorLink& link : graph->sightingsOf(id)) gone.insert(link.id);
    for (const FactorLink& link : graph->otherFactorsOf(id)) {
      gone.insert(link.id);
      const RelativePoseFactor* const edge = keyframeEdge(*graph->factor(link.id));
      if (edge == nullptr) continue;
      const KeyframeId a{edge->node(0).value};
      const KeyframeId b{edge->node(1).value};
      if (is_dropped.count(a) + is_dropped.count(b) == 2) groups.join(a, b);
    }
  }
  std::map<KeyframeId, Gap> gaps;
  for (const FactorId id : gone) {
    const RelativePoseFactor* const edge = keyframeEdge(*graph->factor(id));
    if (edge == nullptr) continue;
    const KeyframeId ends[] = {KeyframeId{edge->node(0).value}, KeyframeId{edge->node(1).value}};
    Gap& gap = gaps[groups.of(is_dropped.count(ends[0]) != 0 ? ends[0] : ends[1])];
    gap.information += edge->information();
    for (const KeyframeId end : ends) {
      if (is_dropped.count(end) == 0) gap.neighbours.insert(end);
    }
  }
  for (const FactorId id : gone) graph->shelve(id, kept);
  for (const auto& [group, gap] : gaps) bridge(gap, graph);
}

}  // namespace mrpt_sgraphs
