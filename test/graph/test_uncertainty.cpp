// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/graph/uncertainty.h"

#include <gtest/gtest.h>

namespace mrpt_sgraphs {
namespace {

/// Keyframes one metre apart along x, each edge with the same sigma of 0.1 m and 0.01 rad.
struct Chain {
  explicit Chain(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      KeyframeNode node;
      node.id = KeyframeId{i};
      node.T_map_base.translation().x() = static_cast<double>(i);
      keyframes.push_back(node);
      if (i > 0) connect(i - 1, i);
    }
  }
  void connect(std::size_t from, std::size_t to) {
    RelativePoseEdge edge;
    edge.from = KeyframeId{from};
    edge.to = KeyframeId{to};
    edge.information.diagonal() << Eigen::Vector3d::Constant(1e2), Eigen::Vector3d::Constant(1e4);
    edges.push_back(edge);
  }
  std::vector<KeyframeNode> keyframes;
  std::vector<RelativePoseEdge> edges;
};

TEST(Uncertainty, AddsUpAlongAChain) {
  const Chain chain(11);
  const auto uncertainty = uncertaintyToNewest(chain.keyframes, chain.edges);
  EXPECT_DOUBLE_EQ(uncertainty.back().norm(), 0.0);
  // along the way: ten times 0.1^2; across it the turns add their levers 0 .. 9 m
  EXPECT_NEAR(uncertainty.front()(0, 0), 10 * 0.01, 1e-9);
  EXPECT_NEAR(uncertainty.front()(1, 1), 10 * 0.01 + 1e-4 * 285.0, 1e-9);
  EXPECT_NEAR(uncertainty.front()(5, 5), 10 * 1e-4, 1e-9);
}

TEST(Uncertainty, TakesTheMostCertainWay) {
  Chain chain(11);
  chain.connect(0, 10);
  const auto uncertainty = uncertaintyToNewest(chain.keyframes, chain.edges);
  EXPECT_NEAR(uncertainty.front()(0, 0), 0.01, 1e-9);
  EXPECT_LT(uncertainty[5](5, 5), 5.5 * 1e-4);
}

TEST(Uncertainty, DoesNotDependOnTheMap) {
  Chain chain(6);
  const auto before = uncertaintyToNewest(chain.keyframes, chain.edges);
  const Pose T_other_map = expPose((Tangent() << 40.0, -7.0, 3.0, 0.4, -0.2, 2.0).finished());
  for (KeyframeNode& node : chain.keyframes) node.T_map_base = T_other_map * node.T_map_base;
  const auto after = uncertaintyToNewest(chain.keyframes, chain.edges);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR((before[i] - after[i]).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
