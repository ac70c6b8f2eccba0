// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

#include "mrpt_sgraphs/hierarchy/local_window.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "random_graph.h"
#include "trials.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr Layer kLayers[] = {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor};

std::vector<NodeId> nodesOf(const LayeredGraph& graph) {
  std::vector<NodeId> nodes;
  for (const Layer layer : kLayers) {
    for (uint32_t slot = 0; slot < graph.size(layer); ++slot) {
      nodes.push_back(graph.nodeAt({layer, slot}));
    }
  }
  return nodes;
}

using Numbers = std::vector<double>;

Numbers numbersOf(const LayeredGraph& graph, NodeId node) {
  const NodeHandle handle = graph.handle(node);
  if (isPlane(node.layer)) {
    const Plane plane = graph.plane(handle);
    return {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.distance};
  }
  const Pose T = graph.pose(handle);
  return Numbers(T.data(), T.data() + T.matrix().size());
}

std::map<NodeId, Numbers> allNumbersOf(const LayeredGraph& graph) {
  std::map<NodeId, Numbers> numbers;
  for (const NodeId node : nodesOf(graph)) numbers[node] = numbersOf(graph, node);
  return numbers;
}

bool areSame(const Numbers& a, const Numbers& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

void addNode(const RandomGraph::Node& node, LayeredGraph* graph) {
  const uint64_t id = node.id.value;
  const auto* const T = std::get_if<Pose>(&node.value);
  const auto* const plane = std::get_if<Plane>(&node.value);
  switch (node.id.layer) {
    case Layer::kKeyframe:
      return graph->restoreKeyframe(KeyframeId{id}, *T, {});
    case Layer::kWall:
      return graph->restoreWall(WallId{id}, *plane, {});
    case Layer::kRoom:
      return graph->restoreRoom(RoomId{id}, *T, {});
    case Layer::kFloor:
      return graph->restoreFloor(FloorId{id}, *plane, {});
  }
}

/// Some of the nodes free, some fixed, some in neither list; rarely one twice or one that is none.
Selection randomSelection(const LayeredGraph& graph, Dice* dice) {
  Selection selection;
  const double free = dice->unit();
  const double fixed = dice->unit();
  for (const NodeId node : nodesOf(graph)) {
    if (dice->chance(free)) {
      selection.free.push_back(node);
    } else if (dice->chance(fixed)) {
      selection.fixed.push_back(node);
    }
  }
  if (dice->chance(0.02)) selection.free.push_back(KeyframeId{dice->below(70)});
  if (dice->chance(0.9)) selection.outside = Selection::Outside::kIsLeftOut;
  return selection;
}

/// What a selection may be refused for.
bool mayBeRefused(const Selection& selection, const LayeredGraph& graph) {
  std::vector<NodeId> nodes = selection.free;
  nodes.insert(nodes.end(), selection.fixed.begin(), selection.fixed.end());
  std::sort(nodes.begin(), nodes.end());
  for (const NodeId node : nodes) {
    if (!graph.contains(node)) return true;
  }
  if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) return true;
  return selection.outside == Selection::Outside::kIsAnError;
}

void optimizeAndCheck(const Selection& selection, Optimizer* optimizer, Dice* dice,
                      LayeredGraph* graph, Tally* tally) {
  const std::map<NodeId, Numbers> before = allNumbersOf(*graph);
  std::vector<NodeId> may_move;
  try {
    const OptimizerReport report =
        optimizeSelection(selection, randomConfig(dice), optimizer, graph);
    checkReport(report);
    tally->add(report);
    if (std::isfinite(report.cost_before)) may_move = selection.free;
  } catch (const std::invalid_argument& error) {
    require(mayBeRefused(selection, *graph), std::string("refused: ") + error.what());
    tally->refused("a selection", error);
  } catch (const std::out_of_range& error) {
    require(mayBeRefused(selection, *graph), std::string("refused: ") + error.what());
    tally->refused("a selection", error);
  }
  for (const auto& [node, numbers] : allNumbersOf(*graph)) {
    const bool finite =
        std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    require(finite, nameOf(node) + " is not finite");
    require(areSame(numbers, before.at(node)) ||
                std::find(may_move.begin(), may_move.end(), node) != may_move.end(),
            nameOf(node) + " has moved");
  }
}

/// What is written can be read, and says the same.
void checkFile(const LayeredGraph& graph) {
  std::ostringstream written;
  writeGraphJson(*graph.snapshot(), written);
  std::istringstream in(written.str());
  std::ostringstream again;
  try {
    writeGraphJson(*readGraphJson(in).snapshot(), again);
  } catch (const std::exception& error) {
    throw Violation(std::string("what was written cannot be read: ") + error.what());
  }
  require(written.str() == again.str(), "what was written is read as another graph");
}

}  // namespace

void tryGraph(Dice* dice, Tally* tally) {
  const RandomGraph made = randomGraph(randomDamage(dice), dice);
  for (const auto& error : made.refusals) tally->refused("to make a factor", error);
  LayeredGraph graph;
  for (const RandomGraph::Node& node : made.nodes) {
    try {
      addNode(node, &graph);
    } catch (const std::invalid_argument& error) {
      tally->refused("a node", error);
    }
  }
  const auto addFactor = [&](const FactorConstPtr& factor) {
    try {
      graph.addFactor(factor);
    } catch (const std::invalid_argument& error) {
      tally->refused("a factor of the graph", error);
    }
  };
  // some factors come later, when windows have gone on
  const std::size_t at_first =
      dice->chance(0.5) ? made.factors.size() : dice->below(made.factors.size() + 1);
  for (std::size_t k = 0; k < at_first; ++k) addFactor(made.factors[k]);

  Optimizer optimizer;
  LocalWindow window(1 + dice->below(12));
  std::size_t next = at_first;
  for (std::size_t rounds = 1 + dice->below(4); rounds > 0; --rounds) {
    switch (dice->below(4)) {
      case 0:
        optimizeAndCheck(selectAll(graph), &optimizer, dice, &graph, tally);
        window.forget();
        break;
      case 1:
        optimizeAndCheck(randomSelection(graph, dice), &optimizer, dice, &graph, tally);
        window.forget();
        break;
      default:
        optimizeAndCheck(window.select(graph), &optimizer, dice, &graph, tally);
    }
    for (std::size_t k = dice->below(8); k > 0 && next < made.factors.size(); --k) {
      addFactor(made.factors[next++]);
    }
    const std::vector<NodeId> nodes = nodesOf(graph);
    if (!nodes.empty() && dice->chance(0.2)) graph.eraseNode(dice->oneOf(nodes));
    if (dice->chance(0.3)) graph.addKeyframe(dice->pose(10.0), {});
  }
  if (dice->chance(0.1)) checkFile(graph);
}

}  // namespace mrpt_sgraphs::test
