// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "semantics/min_cut.h"

namespace mrpt_sgraphs {
namespace {

struct Border {
  std::size_t a;
  std::size_t b;
  double a_inside;
  double b_inside;
};

struct Problem {
  std::vector<double> inside;
  std::vector<double> outside;
  std::vector<Border> borders;

  double costOf(const std::vector<bool>& is_inside) const {
    double cost = 0.0;
    for (std::size_t k = 0; k < inside.size(); ++k) cost += is_inside[k] ? inside[k] : outside[k];
    for (const Border& border : borders) {
      if (is_inside[border.a] && !is_inside[border.b]) cost += border.a_inside;
      if (!is_inside[border.a] && is_inside[border.b]) cost += border.b_inside;
    }
    return cost;
  }
};

TEST(MinCut, CostsNoMoreThanAnyOtherParting) {
  constexpr std::size_t kSize = 9;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> cost(0.0, 2.0);
  for (int round = 0; round < 50; ++round) {
    Problem problem;
    MinCut cut(kSize);
    for (std::size_t k = 0; k < kSize; ++k) {
      problem.inside.push_back(cost(random));
      problem.outside.push_back(cost(random));
      cut.setCosts(k, problem.inside[k], problem.outside[k]);
    }
    for (std::size_t k = 0; k < 2 * kSize; ++k) {
      const Border border{random() % kSize, random() % kSize, cost(random), cost(random)};
      if (border.a == border.b) continue;
      problem.borders.push_back(border);
      cut.addBorder(border.a, border.b, border.a_inside, border.b_inside);
    }
    double least = std::numeric_limits<double>::infinity();
    for (unsigned choice = 0; choice < (1U << kSize); ++choice) {
      std::vector<bool> is_inside;
      for (std::size_t k = 0; k < kSize; ++k) is_inside.push_back((choice >> k) % 2 == 1);
      least = std::min(least, problem.costOf(is_inside));
    }
    EXPECT_NEAR(problem.costOf(cut.solve()), least, 1e-4);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
