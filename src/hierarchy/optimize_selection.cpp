// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"

#include <array>
#include <deque>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/hierarchy/condense.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kOutside = -1;
/// Fixed, and no variable before a factor needs it: most of what a condensed factor ties together is
/// far away from a window.
constexpr int kWaiting = -2;

/// Which variable a node is. A small selection of a large graph does not pay for all its nodes.
class VariableNumbers {
 public:
  VariableNumbers(std::size_t selected, const LayeredGraph& graph) {
    std::size_t nodes = 0;
    for (const Layer layer : kLayers) nodes += graph.size(layer);
    dense_ = nodes < kSparse * selected;
    if (!dense_) {
      sparse_.reserve(selected);
      return;
    }
    for (const Layer layer : kLayers) {
      numbers_[static_cast<std::size_t>(layer)].assign(graph.size(layer), kOutside);
    }
  }

  int of(NodeHandle node) const {
    if (dense_) return numbers_[static_cast<std::size_t>(node.layer)][node.slot];
    const auto found = sparse_.find(key(node));
    return found == sparse_.end() ? kOutside : found->second;
  }

  void set(NodeHandle node, int number) {
    if (dense_) {
      numbers_[static_cast<std::size_t>(node.layer)][node.slot] = number;
    } else {
      sparse_[key(node)] = number;
    }
  }

 private:
  static constexpr Layer kLayers[] = {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor};
  static constexpr std::size_t kSparse = 64;  ///< Nodes for each selected one.

  static uint64_t key(NodeHandle node) {
    return (static_cast<uint64_t>(node.layer) << 32U) | node.slot;
  }

  bool dense_ = true;
  std::array<std::vector<int>, 4> numbers_;  ///< By layer and slot.
  std::unordered_map<uint64_t, int> sparse_;
};

/// The selected part of a graph as a problem for the solver.
class SelectedProblem {
 public:
  SelectedProblem(const Selection& selection, const LayeredGraph& graph)
      : graph_(graph), variables_(selection.free.size() + selection.fixed.size(), graph) {
    problem_.reserve(selection.free.size() + selection.fixed.size(), countLinks(selection));
    for (const NodeId node : selection.free) addVariable(newHandle(node), false);
    for (const NodeId node : selection.fixed) variables_.set(newHandle(node), kWaiting);
    std::vector<char> is_summed(nodes_.size(), 0);
    for (const SummedObservationsFactor& sum : selection.sums) is_summed[addSum(sum)] = 1;
    for (std::size_t k = 0; k < selection.free.size(); ++k) {
      if (is_summed[k] == 0) addFactors(nodes_[k], graph.topology().sightings(nodes_[k]), selection);
      addFactors(nodes_[k], graph.topology().others(nodes_[k]), selection);
    }
  }

  Problem* problem() { return &problem_; }

  void writeBack(LayeredGraph* graph) const {
    for (const NodeHandle node : nodes_) {
      const int variable = variableOf(node);
      if (problem_.isFixed(variable)) break;
      if (isPlane(node.layer)) {
        graph->setPlane(node, problem_.plane(variable));
      } else {
        graph->setPose(node, problem_.pose(variable));
      }
    }
  }

 private:
  std::size_t countLinks(const Selection& selection) const {
    std::size_t links = 0;
    for (const NodeId node : selection.free) links += graph_.factorCountOf(node);
    return links;
  }

  int variableOf(NodeHandle node) const { return variables_.of(node); }

  /// @return The variable that it is about.
  std::size_t addSum(const SummedObservationsFactor& sum) {
    const NodeId surface = sum.node(0);
    const int variable = variableOf(graph_.handle(surface));
    if (variable == kOutside || problem_.isFixed(variable)) {
      throw std::invalid_argument("observations are summed for " + nameOf(surface) +
                                  ", which is not free in the selection");
    }
    problem_.addFactor(sum, &variable);
    return static_cast<std::size_t>(variable);
  }

  void addFactors(NodeHandle node, const Topology::Links& links, const Selection& selection) {
    for (const FactorLink& link : links) addFactor(node, link.slot, selection.outside);
  }

  NodeHandle newHandle(NodeId node) const {
    const NodeHandle handle = graph_.handle(node);
    if (variableOf(handle) != kOutside) {
      throw std::invalid_argument(nameOf(node) + " is selected twice");
    }
    return handle;
  }

  int addVariable(NodeHandle handle, bool fixed) {
    const NodeId node = graph_.nodeAt(handle);
    const int variable = isPlane(node.layer)
                             ? problem_.addVariable(node, graph_.plane(handle), fixed)
                             : problem_.addVariable(node, graph_.pose(handle), fixed);
    variables_.set(handle, variable);
    nodes_.push_back(handle);
    return variable;
  }

  bool isFree(int variable) const { return variable >= 0 && !problem_.isFixed(variable); }

  /// Adds the factor if `node` is the first of its free ones: so none is added twice.
  void addFactor(NodeHandle node, uint32_t factor, Selection::Outside outside) {
    ends_.clear();
    bool found_free = false;
    bool complete = true;
    for (const FactorEnd& end : graph_.topology().ends(factor)) {
      const int variable = variableOf(end.node);
      ends_.push_back(variable);
      if (variable == kOutside) {
        complete = false;
      } else if (!found_free && isFree(variable)) {
        if (!(end.node == node)) return;
        found_free = true;
      }
    }
    const Factor& stored = *graph_.factorAt(factor).factor;
    if (complete) {
      if (addConditioned(stored, factor)) return;
      for (std::size_t k = 0; k < ends_.size(); ++k) {
        if (ends_[k] == kWaiting) ends_[k] = addVariable(graph_.topology().ends(factor)[k].node, true);
      }
      problem_.addFactor(stored, ends_.data());
    } else if (outside == Selection::Outside::kIsAnError) {
      throw std::invalid_argument(nameOf(graph_.nodeAt(node)) + " is joined by " + stored.type() +
                                  " to " + outsideEndsOf(stored) + ", not in the selection");
    }
  }

  /// A condensed factor ties a room's nodes together, of which a window has few.
  /// @return Whether it was one of which enough stays as it is.
  bool addConditioned(const Factor& factor, uint32_t slot) {
    if (ends_.size() < 3 || isFree(ends_[0])) return false;
    const auto* const condensed = dynamic_cast<const CondensedFactor*>(&factor);
    if (condensed == nullptr) return false;
    const auto& nodes = graph_.topology().ends(slot);
    std::vector<Pose> poses(ends_.size());
    std::vector<Plane> planes(ends_.size());
    std::vector<VariableView> values;
    std::vector<bool> is_fixed;
    std::vector<int> moving;
    for (std::size_t k = 0; k < ends_.size(); ++k) {
      is_fixed.push_back(!isFree(ends_[k]));
      if (isPlane(nodes[k].node.layer)) {
        planes[k] = graph_.plane(nodes[k].node);
        values.emplace_back(planes[k]);
      } else {
        poses[k] = graph_.pose(nodes[k].node);
        values.emplace_back(poses[k]);
      }
      if (!is_fixed.back()) moving.push_back(ends_[k]);
    }
    if (moving.size() + 1 == ends_.size()) return false;
    const int kept = ends_[0] == kWaiting ? addVariable(nodes[0].node, true) : ends_[0];
    moving.insert(moving.begin(), kept);
    conditioned_.push_back(conditioned(*condensed, values.data(), is_fixed));
    problem_.addFactor(conditioned_.back(), moving.data());
    return true;
  }

  std::string outsideEndsOf(const Factor& factor) const {
    std::string names;
    for (int k = 0; k < factor.nodeCount(); ++k) {
      const NodeId node = factor.node(k);
      if (variableOf(graph_.handle(node)) != kOutside) continue;
      names += (names.empty() ? "" : ", ") + nameOf(node);
    }
    return names;
  }

  const LayeredGraph& graph_;
  std::deque<CondensedFactor> conditioned_;
  Problem problem_;
  std::vector<NodeHandle> nodes_;              ///< By variable: first the free, then the fixed.
  VariableNumbers variables_;
  std::vector<int> ends_;                      ///< Of the factor at hand.
};

}  // namespace

OptimizerReport optimizeSelection(const Selection& selection, const OptimizerConfig& config,
                                  Optimizer* optimizer, LayeredGraph* graph) {
  SelectedProblem selected(selection, *graph);
  OptimizerReport report = optimizer->optimize(config, selected.problem());
  selected.writeBack(graph);
  return report;
}

OptimizerReport optimizeUnder(const std::vector<FactorConstPtr>& factors,
                              const std::function<bool(NodeId)>& is_free,
                              const OptimizerConfig& config, LayeredGraph* graph) {
  Problem problem;
  std::unordered_map<NodeId, int> variables;
  std::vector<std::pair<NodeHandle, int>> moving;
  std::vector<int> ends;
  for (const FactorConstPtr& factor : factors) {
    ends.clear();
    for (int k = 0; k < factor->nodeCount(); ++k) {
      const NodeId node = factor->node(k);
      const auto [entry, is_new] = variables.try_emplace(node, 0);
      if (is_new) {
        const NodeHandle handle = graph->handle(node);
        const bool moves = is_free(node);
        entry->second = isPlane(node.layer)
                            ? problem.addVariable(node, graph->plane(handle), !moves)
                            : problem.addVariable(node, graph->pose(handle), !moves);
        if (moves) moving.emplace_back(handle, entry->second);
      }
      ends.push_back(entry->second);
    }
    problem.addFactor(*factor, ends.data());
  }
  if (moving.empty()) return {};
  Optimizer optimizer;
  const OptimizerReport report = optimizer.optimize(config, &problem);
  for (const auto& [handle, variable] : moving) {
    if (isPlane(handle.layer)) {
      graph->setPlane(handle, problem.plane(variable));
    } else {
      graph->setPose(handle, problem.pose(variable));
    }
  }
  return report;
}

}  // namespace mrpt_sgraphs
