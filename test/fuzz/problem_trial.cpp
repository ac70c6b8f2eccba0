// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <memory>
#include <set>
#include <unordered_map>

#include "mrpt_sgraphs/solver/chordal_initialization.h"
#include "random_graph.h"
#include "trials.h"

namespace mrpt_sgraphs::test {
namespace {

bool areSame(const Problem& a, const Problem& b, int variable) {
  if (isPlane(a.node(variable).layer)) {
    const Plane& p = a.plane(variable);
    const Plane& q = b.plane(variable);
    return std::memcmp(p.normal.data(), q.normal.data(), sizeof(double) * 3) == 0 &&
           std::memcmp(&p.distance, &q.distance, sizeof(double)) == 0;
  }
  return std::memcmp(a.pose(variable).data(), b.pose(variable).data(), sizeof(double) * 16) == 0;
}

/// All variables are finite, and as much a rotation or a direction as they were.
void checkValues(const Problem& before, const Problem& after) {
  constexpr double kRounding = 1e-9;
  for (int v = 0; v < after.variableCount(); ++v) {
    const std::string name = nameOf(after.node(v));
    require(before.isFixed(v) == after.isFixed(v), name + " is fixed or free as it was not before");
    if (areSame(before, after, v)) continue;
    require(!before.isFixed(v), name + " is fixed and has moved");
    if (isPlane(after.node(v).layer)) {
      require(std::isfinite(after.plane(v).distance), name + " is not finite");
      const auto isUnit = [&](const Plane& plane) {
        return std::abs(plane.normal.norm() - 1.0) < kRounding;
      };
      require(isUnit(after.plane(v)) || !isUnit(before.plane(v)), name + " has no direction");
    } else {
      const auto isRotation = [&](const Eigen::Matrix3d& R) {
        return (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRounding;
      };
      require(after.pose(v).matrix().allFinite(), name + " is not finite");
      require(isRotation(after.pose(v).linear()) || !isRotation(before.pose(v).linear()),
              name + " is no rotation");
    }
  }
}

/// The free variables of parts that nothing holds are named, part by part.
void checkGauge(const Problem& problem, const OptimizerReport& report) {
  const int count = problem.variableCount();
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(count));
  std::vector<bool> reached(static_cast<std::size_t>(count), false);
  std::vector<int> open;
  const auto reach = [&](int v) {
    if (problem.isFixed(v) || reached[static_cast<std::size_t>(v)]) return;
    reached[static_cast<std::size_t>(v)] = true;
    open.push_back(v);
  };
  const auto spread = [&] {
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      for (const int next : neighbours[static_cast<std::size_t>(v)]) reach(next);
    }
  };
  for (int f = 0; f < problem.factorCount(); ++f) {
    const int nodes = problem.factor(f).nodeCount();
    const int* const ends = problem.variablesOf(f);
    for (int k = 0; k < nodes; ++k) {
      for (int j = 0; j < nodes; ++j) {
        neighbours[static_cast<std::size_t>(ends[k])].push_back(ends[j]);
      }
    }
  }
  for (int f = 0; f < problem.factorCount(); ++f) {
    const int nodes = problem.factor(f).nodeCount();
    const int* const ends = problem.variablesOf(f);
    bool held = nodes == 1;
    for (int k = 0; k < nodes; ++k) held = held || problem.isFixed(ends[k]);
    for (int k = 0; held && k < nodes; ++k) reach(ends[k]);
  }
  spread();
  std::set<NodeId> named;
  for (const GaugeFreedom& freedom : report.gauge) {
    require(freedom.dimensions > 0 && !freedom.nodes.empty(), "a free direction of nothing");
    named.insert(freedom.nodes.begin(), freedom.nodes.end());
  }
  for (int v = 0; v < count; ++v) {
    if (problem.isFixed(v) || reached[static_cast<std::size_t>(v)]) continue;
    require(named.count(problem.node(v)) != 0,
            nameOf(problem.node(v)) + " is held by nothing, and the report does not say so");
  }
}

/// The sum of the costs' sizes: what rounding in their sum is relative to.
double costScale(const Problem& problem) {
  double scale = 0.0;
  std::vector<VariableView> views;
  for (int f = 0; f < problem.factorCount(); ++f) {
    views.clear();
    for (int k = 0; k < problem.factor(f).nodeCount(); ++k) {
      views.push_back(problem.view(problem.variablesOf(f)[k]));
    }
    scale += std::abs(problem.factor(f).cost(views.data()));
  }
  return scale;
}

void checkCost(const Problem& before, const Problem& after, const OptimizerReport& report) {
  constexpr double kRounding = 1e-9;
  const double scale = costScale(before) + costScale(after);
  if (!std::isfinite(scale)) return;
  require(std::abs(before.cost() - report.cost_before) <= kRounding * scale,
          "the cost before is another one than the problem's");
  require(std::abs(after.cost() - report.cost_after) <= kRounding * scale,
          "the cost after is another one than the problem's");
}

void optimizeAndCheck(const OptimizerConfig& config, Optimizer* optimizer, Problem* problem,
                      Tally* tally) {
  const Problem before = *problem;
  const OptimizerReport report = optimizer->optimize(config, problem);
  checkReport(report);
  checkValues(before, *problem);
  checkGauge(*problem, report);
  checkCost(before, *problem, report);
  if (!std::isfinite(report.cost_before)) {
    require(!report.converged, "converged, with a cost that is no number");
    for (int v = 0; v < problem->variableCount(); ++v) {
      require(areSame(before, *problem, v), "something moved, without a cost to tell whether to");
    }
  }
  tally->add(report);

  if (config.max_time_s > 0.0) return;
  OptimizerConfig other = config;
  other.threads = 3 - config.threads;
  Problem again = before;
  Optimizer().optimize(other, &again);
  for (int v = 0; v < problem->variableCount(); ++v) {
    require(areSame(again, *problem, v), "one thread and two do not give the same");
  }
}

}  // namespace

OptimizerConfig randomConfig(Dice* dice) {
  OptimizerConfig config;
  config.max_iterations = dice->oneOf(std::vector<int>{1, 2, 5, 50, 50, 200});
  config.max_time_s = dice->oneOf(std::vector<double>{0.0, 0.0, 0.0, 1e-9, 1e-3});
  config.min_relative_decrease = dice->oneOf(std::vector<double>{1e-15, 1e-6, 1e-6, 0.1});
  config.threads = dice->chance(0.3) ? 2 : 1;
  return config;
}

void checkReport(const OptimizerReport& report) {
  require(report.converged == report.problem.empty(),
          "converged with a problem, or neither: '" + report.problem + "'");
  const bool falls = report.cost_after <= report.cost_before;
  const bool is_none = !std::isfinite(report.cost_before) && !std::isfinite(report.cost_after);
  require(falls || is_none, "the cost has risen");
  require(!falls || std::isfinite(report.cost_after) == std::isfinite(report.cost_before),
          "the cost has fallen to infinity");
}

void tryProblem(Dice* dice, Tally* tally) {
  const RandomGraph graph = randomGraph(randomDamage(dice), dice);
  for (const auto& error : graph.refusals) tally->refused("to make a factor", error);
  Problem problem;
  std::unordered_map<NodeId, int> variables;
  for (const RandomGraph::Node& node : graph.nodes) {
    try {
      variables[node.id] = std::visit(
          [&](const auto& value) { return problem.addVariable(node.id, value, node.fixed); },
          node.value);
    } catch (const std::invalid_argument& error) {
      tally->refused("a variable", error);
    }
  }
  std::vector<int> ends;
  for (const FactorConstPtr& factor : graph.factors) {
    ends.clear();
    for (int k = 0; k < factor->nodeCount(); ++k) {
      const auto found = variables.find(factor->node(k));
      ends.push_back(found == variables.end() ? -1 : found->second);
    }
    try {
      problem.addFactor(*factor, ends.data());
    } catch (const std::invalid_argument& error) {
      tally->refused("a factor", error);
    }
  }
  if (dice->chance(0.2)) {
    const Problem before = problem;
    tally->add(initializeChordal(&problem) > 0 ? "chordal start" : "chordal start: none");
    checkValues(before, problem);
  }
  Optimizer optimizer;
  optimizeAndCheck(randomConfig(dice), &optimizer, &problem, tally);
  while (problem.variableCount() > 0 && dice->chance(0.4)) {  // what it remembers must not matter
    const int v = static_cast<int>(dice->below(static_cast<std::size_t>(problem.variableCount())));
    if (dice->chance(0.5)) problem.setFixed(v, !problem.isFixed(v));
    optimizeAndCheck(randomConfig(dice), &optimizer, &problem, tally);
  }
}

}  // namespace mrpt_sgraphs::test
