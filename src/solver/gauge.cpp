// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "gauge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mrpt_sgraphs {
namespace {

/// A node that moves less than this share of the one that moves most does not move.
constexpr double kMovesShare = 1e-6;
/// Of so many free directions the nodes that move are named; of more, those that were held.
constexpr std::size_t kNamedDirections = 24;

/// Disjoint sets, each named by its smallest member.
class Parts {
 public:
  explicit Parts(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(int a, int b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

std::vector<GaugeFreedom> floatingParts(const Problem& problem, std::vector<int>* held) {
  Parts parts(problem.variableCount());
  std::vector<char> touches_ground(static_cast<std::size_t>(problem.variableCount()), 0);
  for (int f = 0; f < problem.factorCount(); ++f) {
    const int nodes = problem.factor(f).nodeCount();
    const int* variables = problem.variablesOf(f);
    int first = -1;
    bool fixed = nodes == 1;  // absolute: it speaks of one node and the map
    for (int k = 0; k < nodes; ++k) {
      if (problem.isFixed(variables[k])) {
        fixed = true;
      } else if (first < 0) {
        first = variables[k];
      } else {
        parts.join(first, variables[k]);
      }
    }
    if (fixed && first >= 0) touches_ground[first] = 1;
  }
  std::vector<char> grounded(touches_ground.size(), 0);
  for (int v = 0; v < problem.variableCount(); ++v) {
    if (touches_ground[v] != 0) grounded[parts.find(v)] = 1;
  }

  std::map<int, GaugeFreedom> floating;
  std::map<int, int> holder;
  for (int v = 0; v < problem.variableCount(); ++v) {
    if (problem.isFixed(v) || grounded[parts.find(v)] != 0) continue;
    const int part = parts.find(v);
    floating[part].nodes.push_back(problem.node(v));
    int& best = holder.emplace(part, v).first->second;
    const auto isBetter = [&](int a, int b) {
      const bool a_plane = isPlane(problem.node(a).layer);
      const bool b_plane = isPlane(problem.node(b).layer);
      return a_plane != b_plane ? b_plane : problem.node(a) < problem.node(b);
    };
    if (isBetter(v, best)) best = v;
  }
  std::vector<GaugeFreedom> result;
  for (auto& [part, freedom] : floating) {
    const int variable = holder.at(part);
    std::sort(freedom.nodes.begin(), freedom.nodes.end());
    freedom.dimensions = problem.tangentSizeOf(variable);
    freedom.held = problem.node(variable);
    held->push_back(variable);
    result.push_back(std::move(freedom));
  }
  return result;
}

std::vector<GaugeFreedom> freeDirections(const NormalEquations& equations,
                                         const std::vector<int>& held_tangents,
                                         const Problem& problem) {
  std::map<int, GaugeFreedom> by_variable;
  std::vector<double> step;
  for (std::size_t k = 0; k < held_tangents.size(); ++k) {
    const int variable = equations.variableOf(held_tangents[k]);
    GaugeFreedom& freedom = by_variable[variable];
    freedom.held = problem.node(variable);
    ++freedom.dimensions;
    freedom.nodes.push_back(freedom.held);
    if (k >= kNamedDirections) continue;
    equations.freeDirection(held_tangents[k], &step);
    double largest = 0.0;
    for (const double x : step) largest = std::max(largest, std::abs(x));
    for (int tangent = 0; tangent < equations.tangents(); ++tangent) {
      if (std::abs(step[tangent]) > kMovesShare * largest) {
        freedom.nodes.push_back(problem.node(equations.variableOf(tangent)));
      }
    }
  }
  std::vector<GaugeFreedom> result;
  for (auto& [variable, freedom] : by_variable) {
    std::sort(freedom.nodes.begin(), freedom.nodes.end());
    freedom.nodes.erase(std::unique(freedom.nodes.begin(), freedom.nodes.end()),
                        freedom.nodes.end());
    result.push_back(std::move(freedom));
  }
  return result;
}

}  // namespace mrpt_sgraphs
