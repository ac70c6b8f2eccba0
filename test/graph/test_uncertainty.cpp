// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/graph/uncertainty.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes one metre apart along x, each edge with the same sigma of 0.1 m and 0.01 rad.
struct Chain {
  explicit Chain(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      KeyframeNode node;
      node.id = KeyframeId{100 - 7 * i};  // any numbers will do
      node.T_map_base.translation().x() = static_cast<double>(i);
      graph.keyframes.push_back(node);
      if (i > 0) connect(i - 1, i);
    }
  }
  void connect(std::size_t from, std::size_t to) {
    Matrix6 information = Matrix6::Identity();
    information.diagonal() << Eigen::Vector3d::Constant(1e2), Eigen::Vector3d::Constant(1e4);
    graph.factors.push_back(
        {{},
         std::make_shared<RelativePoseFactor>(graph.keyframes[from].id, graph.keyframes[to].id,
                                              Pose::Identity(), information)});
  }
  GraphSnapshot graph;
};

TEST(Uncertainty, AddsUpAlongAChain) {
  const Chain chain(11);
  const auto uncertainty = uncertaintyToNewest(chain.graph);
  EXPECT_DOUBLE_EQ(uncertainty.back().norm(), 0.0);
  // along the way: ten times 0.1^2; across it the turns add their levers 0 .. 9 m
  EXPECT_NEAR(uncertainty.front()(0, 0), 10 * 0.01, 1e-9);
  EXPECT_NEAR(uncertainty.front()(1, 1), 10 * 0.01 + 1e-4 * 285.0, 1e-9);
  EXPECT_NEAR(uncertainty.front()(5, 5), 10 * 1e-4, 1e-9);
}

TEST(Uncertainty, TakesTheMostCertainWay) {
  Chain chain(11);
  chain.connect(0, 10);
  const auto uncertainty = uncertaintyToNewest(chain.graph);
  EXPECT_NEAR(uncertainty.front()(0, 0), 0.01, 1e-9);
  EXPECT_LT(uncertainty[5](5, 5), 5.5 * 1e-4);
}

TEST(Uncertainty, DoesNotDependOnTheMap) {
  Chain chain(6);
  const auto before = uncertaintyToNewest(chain.graph);
  const Pose T_other_map = expPose((Tangent() << 40.0, -7.0, 3.0, 0.4, -0.2, 2.0).finished());
  for (std::size_t k = 0; k < chain.graph.keyframes.size(); ++k) {
    KeyframeNode& node = chain.graph.keyframes.edit(k);
    node.T_map_base = T_other_map * node.T_map_base;
  }
  const auto after = uncertaintyToNewest(chain.graph);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR((before[i] - after[i]).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
