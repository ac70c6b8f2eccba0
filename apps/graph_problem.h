// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/io/graph_file.h"
#include "mrpt_sgraphs/solver/problem.h"

namespace mrpt_sgraphs {

/// A file's graph as a problem for the solver: keyframes, then walls, in the order of the file.
/// The keyframes that the file fixes are fixed; if there is none, that of the lowest id.
/// @param graph  Its factors have to outlive the problem.
inline Problem problemOf(const GraphFile& graph) {
  Problem problem;
  problem.reserve(graph.keyframes.size() + graph.walls.size(), graph.factors.size());
  std::unordered_map<NodeId, int> variables;
  variables.reserve(graph.keyframes.size() + graph.walls.size());
  bool any_fixed = false;
  for (const GraphFile::Keyframe& keyframe : graph.keyframes) {
    variables[keyframe.id] = problem.addVariable(keyframe.id, keyframe.T_map_base, keyframe.fixed);
    any_fixed = any_fixed || keyframe.fixed;
  }
  for (const GraphFile::Wall& wall : graph.walls) {
    variables[wall.id] = problem.addVariable(wall.id, wall.plane_map);
  }
  const auto first =
      std::min_element(graph.keyframes.begin(), graph.keyframes.end(),
                       [](const auto& a, const auto& b) { return a.id < b.id; });
  if (!any_fixed && first != graph.keyframes.end()) problem.setFixed(variables.at(first->id), true);

  std::vector<int> ends;
  for (const FactorConstPtr& factor : graph.factors) {
    ends.clear();
    for (int k = 0; k < factor->nodeCount(); ++k) ends.push_back(variables.at(factor->node(k)));
    problem.addFactor(*factor, ends.data());
  }
  return problem;
}

/// Takes the values of problemOf(*graph) over.
inline void takeValues(const Problem& problem, GraphFile* graph) {
  int variable = 0;
  for (auto& keyframe : graph->keyframes) keyframe.T_map_base = problem.pose(variable++);
  for (auto& wall : graph->walls) wall.plane_map = problem.plane(variable++);
}

}  // namespace mrpt_sgraphs
