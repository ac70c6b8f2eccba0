// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "compressed_walk.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/g2o_file.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::CompressedWalk;

GraphFile exported(const LayeredGraph& graph) {
  const test::TemporaryFolder folder;
  std::ofstream file(folder.file("graph.g2o"));
  writeG2o(*graph.snapshot(), file);
  file.close();
  return readG2o(folder.file("graph.g2o"));
}

/// How many pieces the keyframes fall into.
std::size_t parts(const GraphFile& graph) {
  std::map<NodeId, NodeId> above;
  for (const auto& keyframe : graph.keyframes) above[keyframe.id] = keyframe.id;
  const auto top = [&](NodeId node) {
    while (above.at(node) != node) node = above.at(node);
    return node;
  };
  for (const FactorConstPtr& edge : graph.factors) above[top(edge->node(0))] = top(edge->node(1));
  return static_cast<std::size_t>(std::count_if(
      above.begin(), above.end(), [](const auto& entry) { return entry.first == entry.second; }));
}

/// Its cost in g2o's own residual, but the same to second order.
const RelativePoseQuaternionFactor& edge(const GraphFile& graph, uint64_t from, uint64_t to) {
  for (const FactorConstPtr& factor : graph.factors) {
    if (factor->node(0) == NodeId(KeyframeId{from}) && factor->node(1) == NodeId(KeyframeId{to})) {
      return dynamic_cast<const RelativePoseQuaternionFactor&>(*factor);
    }
  }
  throw std::out_of_range("no such edge");
}

/// On the tangent of T_from_to.
Matrix6 informationOf(const RelativePoseQuaternionFactor& factor) {
  Tangent half;
  half << 1.0, 1.0, 1.0, 0.5, 0.5, 0.5;
  return half.asDiagonal() * factor.information() * half.asDiagonal();
}

TEST(PoseGraph, IsTheGraphWhereNothingIsCompressed) {
  const CompressedWalk walk;
  const GraphFile file = exported(walk.graph);
  EXPECT_EQ(file.factors.size(), 6U);
  EXPECT_EQ(parts(file), 1U);
}

TEST(PoseGraph, StaysConnectedWithDroppedKeyframesWhereTheyAre) {
  CompressedWalk walk;
  walk.condense();
  const GraphFile file = exported(walk.graph);
  EXPECT_EQ(file.keyframes.size(), 7U);
  EXPECT_EQ(file.factors.size(), 6U);  // 0-1 and 5-6 are left, 1-5 is condensed, three hang on 1
  EXPECT_EQ(parts(file), 1U);
  for (const uint64_t dropped : {2U, 3U, 4U}) {
    const Pose expected =
        walk.graph.pose(KeyframeId{1}).inverse() * walk.graph.pose(KeyframeId{dropped});
    EXPECT_NEAR(local(expected, edge(file, 1, dropped).T_from_to).norm(), 0.0, 1e-12);
    EXPECT_NEAR((informationOf(edge(file, 1, dropped)) - 1e6 * Matrix6::Identity()).norm(), 0.0,
                1e-3);
  }
}

// Condensed or one by one: what the factors say on keyframe 5 as 1 sees it.
TEST(PoseGraph, EdgesOfACondensedFactorAreItsMarginals) {
  for (const bool with_walls : {true, false}) {
    CompressedWalk walk(with_walls);
    const test::DenseProblem local_problem = walk.inKeptFrame();
    walk.condense();
    std::vector<NodeId> rest;
    for (const auto& [node, value] : local_problem.values) {
      if (node != NodeId(KeyframeId{1}) && node != NodeId(KeyframeId{5})) rest.push_back(node);
    }
    const test::Linearized expected =
        test::schurComplement(local_problem.linearize(), local_problem.rowsOf({KeyframeId{5}}),
                              local_problem.rowsOf(rest));
    const auto& got = edge(exported(walk.graph), 1, 5);
    EXPECT_NEAR((informationOf(got) - expected.H).norm(), 0.0, 1e-8 * expected.H.norm());
    const Pose T_1_5 = std::get<Pose>(local_problem.values.at(KeyframeId{5}));
    const Tangent step = -expected.H.ldlt().solve(expected.g);
    EXPECT_GT(step.norm(), 1e-3);
    EXPECT_NEAR((local(T_1_5, got.T_from_to) - step).norm(), 0.0, 1e-8);
  }
}

/// A condensed factor that knows of keyframe 1 what one wall tells.
void addCondensedByOneWall(const std::optional<Matrix6>& way_covariance, LayeredGraph* graph) {
  graph->addKeyframe(Pose::Identity(), {});
  graph->addKeyframe(Pose(Eigen::Translation3d(3.0, 0.0, 0.0)), {});
  Matrix6 Lambda = Matrix6::Zero();
  Lambda.diagonal() << 1e4, 0.0, 0.0, 0.0, 1e5, 1e5;
  graph->addFactor(std::make_shared<CondensedFactor>(
      KeyframeId{0},
      std::vector<CondensedFactor::Other>{
          {KeyframeId{1}, Pose(Eigen::Translation3d(3.0, 0.0, 0.0)), way_covariance}},
      CondensedFactor::Quadratic{Lambda, 0.1 * Lambda.col(0), 0.0}));
}

TEST(PoseGraph, WhereDirectionsAreOpenTheWayIsTaken) {
  LayeredGraph graph;
  Matrix6 way = Matrix6::Identity();
  way(0, 0) = 0.25;
  way(5, 5) = 0.0;  // cannot be known, and no infinite information may come of it
  addCondensedByOneWall(way, &graph);
  const auto& got = edge(exported(graph), 0, 1);
  Tangent expected;
  expected << 4.0, 1.0, 1.0, 1.0, 1.0, 1e8;
  EXPECT_NEAR((informationOf(got).diagonal() - expected).norm(), 0.0, 1e-6);
  EXPECT_NEAR(got.T_from_to.translation().x(), 3.0, 1e-12);
}

TEST(PoseGraph, WithoutAWayOpenDirectionsAreHeldWeakly) {
  LayeredGraph graph;
  addCondensedByOneWall(std::nullopt, &graph);
  const auto& got = edge(exported(graph), 0, 1);
  Tangent expected;
  expected << 1e4, 1e-2, 1e-2, 1e-2, 1e5, 1e5;
  EXPECT_NEAR((informationOf(got).diagonal() - expected).norm(), 0.0, 1e-6);
  EXPECT_NEAR(got.T_from_to.translation().x(), 3.1, 1e-12);
}

}  // namespace
}  // namespace mrpt_sgraphs
