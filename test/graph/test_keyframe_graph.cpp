// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/graph/keyframe_graph.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

Matrix6 randomInformation(test::RandomGeometry* random) {
  Matrix6 root;
  for (int k = 0; k < 36; ++k) root(k) = random->number(10.0);
  return root * root.transpose() + Matrix6::Identity();
}

TEST(KeyframeGraph, GivesIdsInOrderAndRootsTheNetworkAtTheFirst) {
  KeyframeGraph graph;
  const KeyframeId first = graph.add(1.0, Pose::Identity(), Pose::Identity(), nullptr);
  const KeyframeId second = graph.add(2.0, Pose::Identity(), Pose::Identity(), nullptr);
  EXPECT_LT(first, second);
  EXPECT_EQ(graph.network().root, first.value);
  EXPECT_EQ(graph.network().nodeCount(), 2U);
}

TEST(KeyframeGraph, IsWhatMrptSees) {
  test::RandomGeometry random(5, 20.0);
  KeyframeGraph graph;
  const Pose T_map_a = random.pose();
  const KeyframeId a = graph.add(1.0, T_map_a, Pose::Identity(), nullptr);
  const KeyframeId b = graph.add(2.0, random.pose(), Pose::Identity(), nullptr);
  RelativePoseEdge edge{a, b, random.smallPose(1.0, 0.5), randomInformation(&random),
                        RelativePoseEdge::Kind::kLoopClosure};
  graph.add(edge);

  EXPECT_TRUE(graph.pose(a).isApprox(T_map_a, 1e-12));
  const auto& node = graph.network().nodes.at(a.value);
  EXPECT_DOUBLE_EQ(node.x(), T_map_a.translation().x());

  const RelativePoseEdge back = graph.edge(0);
  EXPECT_EQ(back.from, a);
  EXPECT_EQ(back.to, b);
  EXPECT_EQ(back.kind, edge.kind);
  EXPECT_TRUE(back.T_from_to.isApprox(edge.T_from_to, 1e-12));
  EXPECT_EQ(back.information, edge.information) << "a permutation loses no bit";

  const Pose moved = random.pose();
  graph.setPose(b, moved);
  EXPECT_TRUE(graph.pose(b).isApprox(moved, 1e-12));
  EXPECT_DOUBLE_EQ(graph.network().nodes.at(b.value).y(), moved.translation().y());
}

TEST(KeyframeGraph, PermutesYawPitchRollToRotationAboutXyz) {
  Matrix6 information = Matrix6::Zero();
  information.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // about x, y, z: roll, pitch, yaw
  Tangent expected;
  expected << 1.0, 2.0, 3.0, 6.0, 5.0, 4.0;
  EXPECT_EQ(Tangent(permutedInformation(information).diagonal()), expected);
}

TEST(KeyframeGraph, KeepsParallelEdgesInTheOrderTheyCame) {
  test::RandomGeometry random(6, 5.0);
  KeyframeGraph graph;
  const KeyframeId a = graph.add(1.0, Pose::Identity(), Pose::Identity(), nullptr);
  const KeyframeId b = graph.add(2.0, Pose::Identity(), Pose::Identity(), nullptr);
  RelativePoseEdge odometry{a, b, random.pose(), Matrix6::Identity(), {}};
  RelativePoseEdge loop{a, b, random.pose(), 2.0 * Matrix6::Identity(),
                        RelativePoseEdge::Kind::kLoopClosure};
  graph.add(odometry);
  graph.add(loop);
  ASSERT_EQ(graph.edgeCount(), 2U);
  EXPECT_TRUE(graph.edge(0).T_from_to.isApprox(odometry.T_from_to, 1e-12));
  EXPECT_TRUE(graph.edge(1).T_from_to.isApprox(loop.T_from_to, 1e-12));
}

TEST(KeyframeGraph, RefusesWhatIsNoEdge) {
  KeyframeGraph graph;
  const KeyframeId a = graph.add(1.0, Pose::Identity(), Pose::Identity(), nullptr);
  const KeyframeId b = graph.add(2.0, Pose::Identity(), Pose::Identity(), nullptr);
  RelativePoseEdge edge{a, KeyframeId{99}, Pose::Identity(), Matrix6::Identity(), {}};
  EXPECT_THROW(graph.add(edge), std::invalid_argument);
  edge.to = a;
  EXPECT_THROW(graph.add(edge), std::invalid_argument);
  edge.to = b;
  edge.information(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(graph.add(edge), std::invalid_argument);
  EXPECT_THROW(graph.pose(KeyframeId{99}), std::out_of_range);
  EXPECT_EQ(graph.edgeCount(), 0U);
}

}  // namespace
}  // namespace mrpt_sgraphs
