// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "support/small_problem.h"

namespace mrpt_sgraphs {
namespace {

/// H and g of all free variables in their own order, dense.
struct DenseEquations {
  explicit DenseEquations(const Problem& problem) {
    int size = 0;
    for (int v = 0; v < problem.variableCount(); ++v) {
      first.push_back(problem.isFixed(v) ? -1 : size);
      if (!problem.isFixed(v)) size += problem.tangentSizeOf(v);
    }
    H = Eigen::MatrixXd::Zero(size, size);
    g = Eigen::VectorXd::Zero(size);
    for (int f = 0; f < problem.factorCount(); ++f) add(problem, f);
  }
  void add(const Problem& problem, int f) {
    const Factor& factor = problem.factor(f);
    const int rows = factor.tangentRows();
    std::vector<VariableView> views;
    std::vector<int> index;  // of each of the factor's tangents
    for (int k = 0; k < factor.nodeCount(); ++k) {
      const int variable = problem.variablesOf(f)[k];
      views.push_back(problem.view(variable));
      for (int t = 0; t < problem.tangentSizeOf(variable); ++t) {
        index.push_back(first[variable] < 0 ? -1 : first[variable] + t);
      }
    }
    Eigen::MatrixXd block(rows, rows);
    Eigen::VectorXd gradient(rows);
    cost += factor.linearize(views.data(), block.data(), gradient.data());
    for (int c = 0; c < rows; ++c) {
      if (index[c] < 0) continue;
      g(index[c]) += gradient(c);
      for (int r = c; r < rows; ++r) {
        if (index[r] < 0) continue;
        H(index[r], index[c]) += block(r, c);
        if (r != c) H(index[c], index[r]) += block(r, c);
      }
    }
  }
  std::vector<int> first;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0.0;
};

/// The same for all tangents of a variable that have one unit: its largest diagonal entry.
void addDamping(const Problem& problem, const DenseEquations& dense, double damping,
                Eigen::MatrixXd* H) {
  for (int v = 0; v < problem.variableCount(); ++v) {
    if (problem.isFixed(v)) continue;
    const int size = problem.tangentSizeOf(v);
    const int split = size == 6 ? 3 : 2;
    for (const auto& [from, count] : {std::make_pair(0, split), std::make_pair(split, size - split)}) {
      const int first = dense.first[v] + from;
      const double largest = dense.H.diagonal().segment(first, count).maxCoeff();
      H->diagonal().segment(first, count).array() += damping * largest;
    }
  }
}

/// The step in the order of DenseEquations.
Eigen::VectorXd stepOf(const NormalEquations& equations, const DenseEquations& dense) {
  std::vector<double> step;
  equations.solve(&step);
  Eigen::VectorXd result(dense.g.size());
  for (int t = 0; t < equations.tangents();) {
    const int variable = equations.variableOf(t);
    int k = 0;
    for (; t < equations.tangents() && equations.variableOf(t) == variable; ++t, ++k) {
      result(dense.first[variable] + k) = step[t];
    }
  }
  return result;
}

class NormalEquationsTest : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Keyframes, NormalEquationsTest, ::testing::Values(2, 3, 7, 50, 130));

TEST_P(NormalEquationsTest, AgreeWithADenseSolver) {
  const test::SmallWorld world(GetParam());
  for (const double damping : {0.0, 0.1}) {
    const Problem problem = world.problem();
    const DenseEquations dense(problem);
    NormalEquations equations(problem);
    equations.bind(problem);
    const NormalEquations::Sweep sweep = equations.factorize(damping, 1);
    Eigen::MatrixXd H = dense.H;
    addDamping(problem, dense, damping, &H);
    const Eigen::VectorXd expected = -H.ldlt().solve(dense.g);
    EXPECT_NEAR(sweep.cost, dense.cost, 1e-10 * dense.cost);
    EXPECT_NEAR(sweep.cost, problem.cost(), 1e-10 * dense.cost);
    EXPECT_NEAR(sweep.decrease, -dense.g.dot(expected), 1e-8 * sweep.decrease);
    EXPECT_TRUE(sweep.held.empty());
    EXPECT_NEAR((stepOf(equations, dense) - expected).norm(), 0.0, 1e-8 * expected.norm());
    EXPECT_NEAR(equations.cost(), dense.cost, 1e-10 * dense.cost);
  }
}

TEST_P(NormalEquationsTest, LeaveOutFixedVariablesAnywhere) {
  const test::SmallWorld world(GetParam());
  Problem problem = world.problem();
  for (int v = 0; v < problem.variableCount(); v += 3) problem.setFixed(v, true);
  const DenseEquations dense(problem);
  NormalEquations equations(problem);
  equations.bind(problem);
  const NormalEquations::Sweep sweep = equations.factorize(0.0, 1);
  EXPECT_EQ(equations.tangents(), dense.g.size());
  EXPECT_NEAR(sweep.cost, dense.cost, 1e-10 * dense.cost);
  const Eigen::VectorXd expected = -dense.H.ldlt().solve(dense.g);
  EXPECT_NEAR((stepOf(equations, dense) - expected).norm(), 0.0, 1e-8 * expected.norm());
}

TEST(NormalEquations, GiveTheSameBitsWithAnyNumberOfThreads) {
  const test::SmallWorld world(4000);
  const Problem problem = world.problem();
  std::vector<double> steps[3];
  double costs[3];
  for (const int threads : {1, 2, 3}) {
    NormalEquations equations(problem);
    ASSERT_GT(equations.plan().subtrees.size(), 1U) << "too small to be shared";
    equations.bind(problem);
    costs[threads - 1] = equations.factorize(0.0, threads).cost;
    equations.solve(&steps[threads - 1]);
  }
  EXPECT_EQ(steps[0], steps[1]);
  EXPECT_EQ(steps[0], steps[2]);
  EXPECT_EQ(costs[0], costs[1]);
  EXPECT_EQ(costs[0], costs[2]);
}

TEST(NormalEquations, KnowWhichProblemsTheyFit) {
  const test::SmallWorld world(20);
  Problem problem = world.problem();
  const NormalEquations equations(problem);
  EXPECT_TRUE(equations.fits(problem));
  EXPECT_TRUE(equations.fits(world.problem(0.01, 0.01)));
  EXPECT_TRUE(equations.fits(test::SmallWorld(20, 5).problem()));
  EXPECT_FALSE(equations.fits(test::SmallWorld(21).problem()));
  problem.setFixed(7, true);
  EXPECT_FALSE(equations.fits(problem));
}

TEST(EliminationPlan, HasEachVariableOnceAndChildrenBeforeParents) {
  const test::SmallWorld world(500);
  const EliminationPlan plan = NormalEquations(world.problem()).plan();
  std::vector<int> order = plan.order;
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(order[k], static_cast<int>(k));
  int pivots = 0;
  for (std::size_t f = 0; f < plan.fronts.size(); ++f) {
    const Front& front = plan.fronts[f];
    EXPECT_EQ(front.first_pivot, pivots);
    pivots += front.pivots;
    EXPECT_TRUE(front.parent < 0 || front.parent > static_cast<int>(f));
    for (int r = 0; r < front.rows; ++r) EXPECT_GE(plan.rows[front.first_row + r], pivots);
  }
  EXPECT_EQ(pivots, plan.tangent.back());
}

TEST(EliminationPlan, TakesNestedDissectionWhereTheFillIsLarge) {
  // a cube of poses, each tied to its neighbours; and a chain
  VariableGraph cube;
  constexpr int kSide = 14;
  const auto index = [](int x, int y, int z) { return (z * kSide + y) * kSide + x; };
  cube.first.push_back(0);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (int step : {-1, 1}) {
          if (x + step >= 0 && x + step < kSide) cube.neighbours.push_back(index(x + step, y, z));
          if (y + step >= 0 && y + step < kSide) cube.neighbours.push_back(index(x, y + step, z));
          if (z + step >= 0 && z + step < kSide) cube.neighbours.push_back(index(x, y, z + step));
        }
        cube.sizes.push_back(6);
        cube.first.push_back(static_cast<int>(cube.neighbours.size()));
      }
    }
  }
  EXPECT_TRUE(planElimination(cube).nested_dissection);
  EXPECT_FALSE(NormalEquations(test::SmallWorld(500).problem()).plan().nested_dissection);
}

}  // namespace
}  // namespace mrpt_sgraphs
