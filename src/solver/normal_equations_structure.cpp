// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// What NormalEquations finds out about a structure, once; the sweeps are in normal_equations.cpp.
#include <algorithm>

#include "normal_equations.h"

namespace mrpt_sgraphs {
namespace {

/// Free variables numbered, and which of them share a factor.
VariableGraph variableGraph(const Problem& problem, const std::vector<int>& number,
                            const std::vector<int>& free_variables) {
  VariableGraph graph;
  for (const int variable : free_variables) graph.sizes.push_back(problem.tangentSizeOf(variable));
  const std::size_t count = free_variables.size();

  std::vector<int> degree(count + 1, 0);
  const auto forEachPair = [&](auto&& visit) {
    for (int f = 0; f < problem.factorCount(); ++f) {
      const int* variables = problem.variablesOf(f);
      const int nodes = problem.factor(f).nodeCount();
      for (int a = 0; a < nodes; ++a) {
        const int from = number[variables[a]];
        if (from < 0) continue;
        for (int b = 0; b < nodes; ++b) {
          const int to = number[variables[b]];
          if (to >= 0 && to != from) visit(from, to);
        }
      }
    }
  };
  forEachPair([&](int from, int) { ++degree[from]; });
  std::vector<int> begin(count + 1, 0);
  for (std::size_t k = 0; k < count; ++k) begin[k + 1] = begin[k] + degree[k];
  std::vector<int> all(static_cast<std::size_t>(begin[count]));
  std::vector<int> next(begin.begin(), begin.end() - 1);
  forEachPair([&](int from, int to) { all[next[from]++] = to; });

  // each neighbour once
  graph.first.push_back(0);
  graph.neighbours.reserve(all.size());
  std::vector<int> seen(count, -1);
  for (int k = 0; k < static_cast<int>(count); ++k) {
    for (int e = begin[k]; e < begin[k + 1]; ++e) {
      if (seen[all[e]] == k) continue;
      seen[all[e]] = k;
      graph.neighbours.push_back(all[e]);
    }
    graph.first.push_back(static_cast<int>(graph.neighbours.size()));
  }
  return graph;
}

/// Everything that the plan depends on.
std::vector<int> structureOf(const Problem& problem) {
  std::vector<int> structure;
  structure.reserve(static_cast<std::size_t>(problem.variableCount() + 4 * problem.factorCount()));
  for (int v = 0; v < problem.variableCount(); ++v) {
    structure.push_back(problem.isFixed(v) ? 0 : problem.tangentSizeOf(v));
  }
  for (int f = 0; f < problem.factorCount(); ++f) {
    const int nodes = problem.factor(f).nodeCount();
    structure.push_back(nodes);
    structure.insert(structure.end(), problem.variablesOf(f), problem.variablesOf(f) + nodes);
  }
  return structure;
}

}  // namespace

NormalEquations::NormalEquations(const Problem& problem) : structure_(structureOf(problem)) {
  std::vector<int> number(static_cast<std::size_t>(problem.variableCount()), -1);
  for (int v = 0; v < problem.variableCount(); ++v) {
    if (problem.isFixed(v)) continue;
    number[v] = static_cast<int>(free_variables_.size());
    free_variables_.push_back(v);
  }
  plan_ = planElimination(variableGraph(problem, number, free_variables_));
  std::vector<int> ordered(free_variables_.size());
  for (std::size_t k = 0; k < ordered.size(); ++k) ordered[k] = free_variables_[plan_.order[k]];
  free_variables_ = std::move(ordered);

  assignFactors(problem);
  views_.resize(ends_.size());
  panels_.reset(new double[plan_.panel_memory]);  // not initialized: each sweep does that
  updates_.reset(new double[plan_.update_memory]);
  scales_.resize(static_cast<std::size_t>(tangents()));
  front_cost_.resize(plan_.fronts.size());
  front_decrease_.resize(plan_.fronts.size());
}

bool NormalEquations::fits(const Problem& problem) const {
  return structureOf(problem) == structure_;
}

void NormalEquations::assignFactors(const Problem& problem) {
  std::vector<int> position(static_cast<std::size_t>(problem.variableCount()), -1);
  for (std::size_t k = 0; k < free_variables_.size(); ++k) {
    position[free_variables_[k]] = static_cast<int>(k);
  }
  // The front of a factor eliminates its first free variable; the others are among its rows.
  const int fronts = static_cast<int>(plan_.fronts.size());
  std::vector<int> front_of(static_cast<std::size_t>(problem.factorCount()));
  first_factor_.assign(static_cast<std::size_t>(fronts) + 2, 0);
  for (int f = 0; f < problem.factorCount(); ++f) {
    int first = -1;
    for (int k = 0; k < problem.factor(f).nodeCount(); ++k) {
      const int at = position[problem.variablesOf(f)[k]];
      if (at >= 0 && (first < 0 || at < first)) first = at;
    }
    front_of[f] = first < 0 ? fronts : plan_.front_of[first];
    ++first_factor_[front_of[f] + 1];
  }
  for (int f = 0; f <= fronts; ++f) first_factor_[f + 1] += first_factor_[f];
  std::vector<int> next(first_factor_.begin(), first_factor_.end() - 1);
  factor_order_.resize(front_of.size());
  for (int f = 0; f < problem.factorCount(); ++f) factor_order_[next[front_of[f]]++] = f;

  std::vector<int> row_of(static_cast<std::size_t>(tangents()));
  int ends = 0;
  for (const int f : factor_order_) ends += problem.factor(f).nodeCount();
  ends_.reserve(static_cast<std::size_t>(ends));
  factors_.reserve(factor_order_.size());
  for (int index = 0; index <= fronts; ++index) {
    if (index < fronts) {
      const Front& front = plan_.fronts[index];
      for (int k = 0; k < front.pivots; ++k) row_of[front.first_pivot + k] = k;
      for (int k = 0; k < front.rows; ++k) row_of[plan_.rows[front.first_row + k]] = front.pivots + k;
    }
    for (int k = first_factor_[index]; k < first_factor_[index + 1]; ++k) {
      const int f = factor_order_[k];
      const int nodes = problem.factor(f).nodeCount();
      BoundFactor bound;
      bound.first_end = static_cast<int>(ends_.size());
      bound.ends = nodes;
      for (int n = 0; n < nodes; ++n) {
        const int variable = problem.variablesOf(f)[n];
        End end;
        end.size = problem.tangentSizeOf(variable);
        end.offset = position[variable] < 0 ? -1 : row_of[plan_.tangent[position[variable]]];
        ends_.push_back(end);
        bound.tangents += end.size;
      }
      max_tangents_ = std::max(max_tangents_, bound.tangents);
      factors_.push_back(bound);
    }
  }
}

void NormalEquations::bind(const Problem& problem) {
  for (std::size_t k = 0; k < factors_.size(); ++k) {
    const int f = factor_order_[k];
    factors_[k].factor = &problem.factor(f);
    for (int n = 0; n < factors_[k].ends; ++n) {
      views_[factors_[k].first_end + n] = problem.view(problem.variablesOf(f)[n]);
    }
  }
}

}  // namespace mrpt_sgraphs
