// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/compression.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/hierarchy/condense.h"
#include "mrpt_sgraphs/hierarchy/transfer.h"

namespace mrpt_sgraphs {
namespace {

std::vector<FactorId> factorsOf(KeyframeId id, const LayeredGraph& graph) {
  std::vector<FactorId> ids;
  for (const FactorLink& link : graph.sightingsOf(id)) ids.push_back(link.id);
  for (const FactorLink& link : graph.otherFactorsOf(id)) ids.push_back(link.id);
  return ids;
}

/// The factors of some keyframes, each once and in the order of their ids.
std::vector<FactorId> factorsOf(const std::vector<KeyframeId>& keyframes,
                                const LayeredGraph& graph) {
  std::set<FactorId> ids;
  for (const KeyframeId id : keyframes) {
    for (const FactorId factor : factorsOf(id, graph)) ids.insert(factor);
  }
  return {ids.begin(), ids.end()};
}

const CondensedFactor* asCondensed(FactorId id, const LayeredGraph& graph) {
  return dynamic_cast<const CondensedFactor*>(graph.factor(id).get());
}

std::optional<FactorId> condensedFactorOf(KeyframeId kept, const LayeredGraph& graph) {
  for (const FactorLink& link : graph.otherFactorsOf(kept)) {
    const CondensedFactor* const condensed = asCondensed(link.id, graph);
    if (condensed != nullptr && condensed->kept() == kept) return link.id;
  }
  return std::nullopt;
}

/// The keyframes whose factors are on the shelf for a kept one.
std::vector<KeyframeId> droppedFor(KeyframeId kept, const LayeredGraph& graph) {
  std::set<KeyframeId> dropped;
  for (const FactorId id : graph.shelf().keptBy(kept)) {
    const FactorConstPtr& factor = graph.factor(id);
    for (int k = 0; k < factor->nodeCount(); ++k) {
      const NodeId node = factor->node(k);
      if (node.layer != Layer::kKeyframe) continue;
      const KeyframeId keyframe{node.value};
      if (graph.attributes(keyframe).marginalized) dropped.insert(keyframe);
    }
  }
  return {dropped.begin(), dropped.end()};
}

/// Makes the condensed factor of a kept keyframe from what is on the shelf for it.
/// @return False, and nothing has changed, if some keyframe is not determined.
bool condenseShelved(KeyframeId kept, const std::vector<KeyframeId>& dropped,
                     LayeredGraph* graph) {
  std::vector<FactorId> ids = graph->shelf().keptBy(kept);
  std::sort(ids.begin(), ids.end());
  std::vector<FactorConstPtr> factors;
  for (const FactorId id : ids) factors.push_back(graph->factor(id));
  const auto condensed = condenseInSteps(factors, kept, dropped, *graph);
  if (condensed == nullptr) return false;
  if (const std::optional<FactorId> own = condensedFactorOf(kept, *graph)) {
    graph->replaceFactor(*own, condensed);
  } else {
    graph->addFactor(condensed);
  }
  return true;
}

void setDropped(KeyframeId id, std::optional<KeyframeId> representative, LayeredGraph* graph) {
  KeyframeAttributes attributes = graph->attributes(id);
  attributes.marginalized = representative.has_value();
  attributes.representative = representative;
  graph->setAttributes(id, attributes);
}

}  // namespace

/// Keyframes that have come since, and those of a graph that was loaded.
void Compression::takeIn(const LayeredGraph& graph) {
  const auto count = static_cast<uint32_t>(graph.size(Layer::kKeyframe));
  for (; known_ < count; ++known_) {
    const KeyframeId id{graph.nodeAt({Layer::kKeyframe, known_}).value};
    const KeyframeAttributes& keyframe = graph.attributes(id);
    if (keyframe.marginalized && keyframe.representative) {
      followers_.add(*keyframe.representative, graph.pose(*keyframe.representative), id);
    } else {
      active_.push_back(id);
    }
  }
}

std::vector<RegionPlan> Compression::due(const LayeredGraph& graph, bool changed) {
  takeIn(graph);
  const bool is_paper = config_.mode == "paper";
  if (config_.mode == "baseline" || known_ == 0) return {};
  if (!changed && known_ < looked_at_ + static_cast<uint32_t>(config_.min_condensed)) return {};
  looked_at_ = known_;
  // to the letter, whatever stands in the room is dropped; the newest is the next one's neighbour
  const auto window = is_paper ? 1U : static_cast<uint32_t>(config_.local_keyframes);
  return planRegions(graph, active_, known_ > window ? known_ - window : 0, config_);
}

KeyframeId Compression::standIn(KeyframeId id, const std::vector<KeyframeId>& stay,
                                const LayeredGraph& graph) const {
  const Eigen::Vector3d place_map = graph.pose(id).translation();
  KeyframeId nearest = stay.front();
  double least_m = std::numeric_limits<double>::infinity();
  for (const KeyframeId candidate : stay) {
    const double distance_m = (graph.pose(candidate).translation() - place_map).norm();
    if (distance_m >= least_m) continue;
    least_m = distance_m;
    nearest = candidate;
  }
  return nearest;
}

void Compression::apply(const RegionPlan& plan, LayeredGraph* graph) {
  for (const KeyframeId id : plan.dropped) carryOver(id, standIn(id, plan.stay, *graph), graph);
  if (config_.mode == "paper") {
    marginalizeByTheLetter(plan.kept, plan.dropped, graph);
  } else if (!condenseRegion(plan, graph)) {
    return;
  }
  drop(plan, graph);
}

void Compression::drop(const RegionPlan& plan, LayeredGraph* graph) {
  for (const KeyframeId id : plan.dropped) {
    followers_.place(id, graph);
    std::vector<KeyframeId> moved = followers_.take(id);
    moved.push_back(id);
    for (const KeyframeId follower : moved) {
      const KeyframeId representative = standIn(follower, plan.stay, *graph);
      setDropped(follower, representative, graph);
      followers_.place(representative, graph);
      followers_.add(representative, graph->pose(representative), follower);
    }
  }
  const std::set<KeyframeId> dropped(plan.dropped.begin(), plan.dropped.end());
  active_.erase(std::remove_if(active_.begin(), active_.end(),
                               [&](KeyframeId id) { return dropped.count(id) != 0; }),
                active_.end());
}

/// @return False, and nothing has changed, if some keyframe is not determined.
bool Compression::condenseRegion(const RegionPlan& plan, LayeredGraph* graph) {
  // keyframes with an edge to be transferred last: by then the rest is small
  std::vector<KeyframeId> first;
  std::vector<KeyframeId> last;
  std::vector<std::pair<FactorId, KeyframeId>> transfers;
  for (const KeyframeId id : plan.dropped) {
    bool has_transfer = false;
    for (const FactorLink& link : graph->otherFactorsOf(id)) {
      if (plan.transferred.count(link.id) == 0) continue;
      transfers.emplace_back(link.id, id);
      has_transfer = true;
    }
    (has_transfer ? last : first).push_back(id);
  }
  std::vector<FactorId> ids = factorsOf(plan.dropped, *graph);
  ids.erase(std::remove_if(ids.begin(), ids.end(),
                           [&](FactorId id) { return plan.transferred.count(id) != 0; }),
            ids.end());
  const std::optional<FactorId> own = condensedFactorOf(plan.kept, *graph);
  if (own && std::find(ids.begin(), ids.end(), *own) == ids.end()) ids.push_back(*own);

  std::vector<FactorConstPtr> early;
  std::vector<FactorConstPtr> late;
  const std::set<NodeId> is_late(last.begin(), last.end());
  const std::set<NodeId> is_early(first.begin(), first.end());
  for (const FactorId id : ids) {
    const FactorConstPtr& factor = graph->factor(id);
    bool is_of_early = false;
    for (int k = 0; k < factor->nodeCount(); ++k) {
      if (is_early.count(factor->node(k)) != 0) is_of_early = true;
    }
    const bool goes_early = !first.empty() && (is_of_early || (own && id == *own));
    (goes_early ? early : late).push_back(factor);
  }
  std::shared_ptr<const CondensedFactor> condensed;
  if (!first.empty()) {
    condensed = condenseInSteps(early, plan.kept, first, *graph);
    if (condensed == nullptr) return false;
    late.push_back(condensed);
  }
  std::vector<RelativePoseFactor> edges;
  for (const auto& [id, gone] : transfers) {
    const KeyframeId stays = standIn(gone, plan.stay, *graph);
    std::vector<FactorConstPtr> known = late;  // and what the one that stays sees of the same walls
    for (const FactorLink& link : graph->sightingsOf(stays)) known.push_back(graph->factor(link.id));
    edges.push_back(transferred(*keyframeEdge(*graph->factor(id)), gone, stays,
                                relativeCovariance(known, stays, gone, *graph), *graph));
  }
  if (!last.empty()) {
    condensed = condenseInSteps(late, plan.kept, last, *graph);
    if (condensed == nullptr) return false;
  }

  for (const FactorId id : ids) {
    if (id == own) continue;
    const CondensedFactor* const other = asCondensed(id, *graph);
    if (other == nullptr) {
      graph->shelve(id, plan.kept);
    } else {  // of a region that is one with this now
      const std::vector<FactorId> shelved = graph->shelf().keptBy(other->kept());
      for (const FactorId theirs : shelved) graph->setKept(theirs, plan.kept);
      graph->eraseFactor(id);
    }
  }
  for (const auto& transfer : transfers) {
    if (!graph->shelf().contains(transfer.first)) graph->shelve(transfer.first, std::nullopt);
  }
  if (own) {
    graph->replaceFactor(*own, condensed);
  } else {
    graph->addFactor(condensed);
  }
  for (const RelativePoseFactor& edge : edges) addTransferred(edge, graph);
  return true;
}

bool Compression::mend(LayeredGraph* graph) {
  takeIn(*graph);
  const std::set<KeyframeId> broken = graph->brokenShelves();
  for (const KeyframeId kept : broken) {
    graph->setMended(kept);
    if (graph->contains(kept)) makeAgain(kept, graph);
  }
  return !broken.empty();
}

bool Compression::makeAgain(KeyframeId kept, LayeredGraph* graph) {
  const std::vector<KeyframeId> dropped = droppedFor(kept, *graph);
  for (const KeyframeId id : dropped) {
    carryOver(id, graph->attributes(id).representative.value_or(kept), graph);
  }
  for (const FactorId id : factorsOf(dropped, *graph)) graph->shelve(id, kept);
  if (config_.mode == "paper") return true;
  resolveDropped(kept, OptimizerConfig{}, graph);
  return condenseShelved(kept, dropped, graph);
}

bool Compression::condenseAgain(KeyframeId kept, LayeredGraph* graph) {
  return condenseShelved(kept, droppedFor(kept, *graph), graph);
}

double Compression::resolve(const OptimizerConfig& optimizer, LayeredGraph* graph) {
  CpuStopwatch watch;
  followers_.placeAll(graph);
  for (const KeyframeId id : active_) {
    if (condensedFactorOf(id, *graph)) resolveDropped(id, optimizer, graph);
  }
  return watch.lap();
}

void Compression::restore(LayeredGraph* graph) {
  std::vector<FactorId> stand_ins;
  for (const StoredFactor& stored : graph->snapshot()->factors) {
    const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
    const bool is_bridge = edge != nullptr && edge->kind == RelativePoseFactor::Kind::kBridge;
    if (is_bridge || asCondensed(stored.id, *graph) != nullptr) stand_ins.push_back(stored.id);
  }
  for (const FactorId id : stand_ins) graph->eraseFactor(id);
  std::vector<FactorId> shelved;
  for (const ShelvedFactor& factor : graph->snapshot()->shelved) shelved.push_back(factor.id);
  std::sort(shelved.begin(), shelved.end());
  for (const FactorId id : shelved) {
    const RelativePoseFactor* const edge = keyframeEdge(*graph->factor(id));
    if (edge != nullptr && edge->kind == RelativePoseFactor::Kind::kBridge) {
      graph->eraseFactor(id);  // what it stands for is there as well
    } else {
      graph->unshelve(id);
    }
  }
  const std::set<KeyframeId> broken = graph->brokenShelves();
  for (const KeyframeId kept : broken) graph->setMended(kept);
  active_.clear();
  for (uint32_t slot = 0; slot < graph->size(Layer::kKeyframe); ++slot) {
    const KeyframeId id{graph->nodeAt({Layer::kKeyframe, slot}).value};
    if (graph->attributes(id).marginalized) setDropped(id, std::nullopt, graph);
    active_.push_back(id);
  }
  known_ = static_cast<uint32_t>(active_.size());
  followers_.clear();
}

}  // namespace mrpt_sgraphs
