// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/optimize_selection.h"

#include <array>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {
namespace {

constexpr int kOutside = -1;

/// The selected part of a graph as a problem for the solver.
class SelectedProblem {
 public:
  SelectedProblem(const Selection& selection, const SituationalGraph& graph) : graph_(graph) {
    for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
      variables_[static_cast<std::size_t>(layer)].assign(graph.size(layer), kOutside);
    }
    problem_.reserve(selection.free.size() + selection.fixed.size(), countLinks(selection));
    for (const NodeId node : selection.free) addVariable(node, false);
    for (const NodeId node : selection.fixed) addVariable(node, true);
    for (const NodeHandle node : nodes_) {
      if (problem_.isFixed(variableOf(node))) break;  // the free ones come first
      for (const FactorLink& link : graph.topology().links(node)) {
        addFactor(node, link.slot, selection.outside);
      }
    }
  }

  Problem* problem() { return &problem_; }

  void writeBack(SituationalGraph* graph) const {
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
    for (const NodeId node : selection.free) links += graph_.factorsOf(node).size();
    return links;
  }

  int& variableOf(NodeHandle node) {
    return variables_[static_cast<std::size_t>(node.layer)][node.slot];
  }
  int variableOf(NodeHandle node) const {
    return variables_[static_cast<std::size_t>(node.layer)][node.slot];
  }

  void addVariable(NodeId node, bool fixed) {
    const NodeHandle handle = graph_.handle(node);
    int& variable = variableOf(handle);
    if (variable != kOutside) throw std::invalid_argument(nameOf(node) + " is selected twice");
    variable = isPlane(node.layer) ? problem_.addVariable(node, graph_.plane(handle), fixed)
                                   : problem_.addVariable(node, graph_.pose(handle), fixed);
    nodes_.push_back(handle);
  }

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
      } else if (!found_free && !problem_.isFixed(variable)) {
        if (!(end.node == node)) return;
        found_free = true;
      }
    }
    const Factor& stored = *graph_.factorAt(factor).factor;
    if (complete) {
      problem_.addFactor(stored, ends_.data());
    } else if (outside == Selection::Outside::kIsAnError) {
      throw std::invalid_argument(nameOf(graph_.nodeAt(node)) + " is joined by " + stored.type() +
                                  " to " + outsideEndsOf(stored) + ", not in the selection");
    }
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

  const SituationalGraph& graph_;
  Problem problem_;
  std::vector<NodeHandle> nodes_;              ///< By variable: first the free, then the fixed.
  std::array<std::vector<int>, 4> variables_;  ///< By layer and slot.
  std::vector<int> ends_;                      ///< Of the factor at hand.
};

}  // namespace

OptimizerReport optimizeSelection(const Selection& selection, const OptimizerConfig& config,
                                  Optimizer* optimizer, SituationalGraph* graph) {
  SelectedProblem selected(selection, *graph);
  OptimizerReport report = optimizer->optimize(config, selected.problem());
  selected.writeBack(graph);
  return report;
}

}  // namespace mrpt_sgraphs
