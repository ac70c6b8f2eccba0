// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/hierarchy/put_together.h"
#include "mrpt_sgraphs/hierarchy/whole_graph.h"
#include "mrpt_sgraphs/hierarchy/whole_graph_regions.h"
#include "support/storey_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::StoreyLab;

/// To the last digit, so that two ways to the same optimum can be compared.
OptimizerConfig exact() {
  OptimizerConfig config;
  config.min_relative_decrease = 1e-12;
  return config;
}

/// Two tours; the corridor is no room, and a loop is closed in it.
class WholeGraphTest : public ::testing::Test {
 protected:
  WholeGraphTest() {
    fill(&lab_);
    fill(&full_);
    full_.optimize();
  }

  static void fill(StoreyLab* lab) {
    lab->tour();
    lab->tour();
    lab->close({1}, {lab->truth.size() - 2});
    for (const KeyframeId id : lab->keyframes[StoreyLab::kCorridor]) {
      KeyframeAttributes attributes = lab->graph.attributes(id);
      attributes.room.reset();
      lab->graph.setAttributes(id, attributes);
    }
  }

  /// Everything from the second tour on is as far off as odometry can be.
  static void drift(LayeredGraph* graph) {
    Pose error = Pose::Identity();
    error.translation() << 8.0, -5.0, 3.0;
    error.linear() = expSO3({0.03, -0.05, 0.6});
    const auto keyframes = static_cast<uint32_t>(graph->size(Layer::kKeyframe));
    for (uint32_t slot = keyframes / 2; slot < keyframes; ++slot) {
      const NodeHandle node{Layer::kKeyframe, slot};
      graph->setPose(node, orthonormalized(error * graph->pose(node)));
    }
  }

  void expectTheFullOptimum() const {
    for (uint64_t k = 0; k < lab_.truth.size(); ++k) {
      const Pose difference =
          full_.graph.pose(KeyframeId{k}).inverse() * lab_.graph.pose(KeyframeId{k});
      EXPECT_LT(logPose(difference).norm(), 1e-4) << k;
    }
    for (const auto& walls : lab_.walls) {
      for (const WallId wall : walls) {
        EXPECT_LT(local(full_.graph.plane(wall), lab_.graph.plane(wall)).norm(), 1e-4)
            << wall.value;
      }
    }
  }

  /// Of the factors as they were before anything was dropped.
  static double fullCost(const StoreyLab& lab) {
    double cost = 0.0;
    for (const StoredFactor& stored : lab.graph.snapshot()->factors) {
      const Factor& factor = *stored.factor;
      const NodeId surface = factor.node(1);
      const Pose first = lab.graph.pose(KeyframeId{factor.node(0).value});
      const NodeHandle second = lab.graph.handle(surface);
      const Pose pose = isPlane(surface.layer) ? Pose::Identity() : lab.graph.pose(second);
      const Plane plane = isPlane(surface.layer) ? lab.graph.plane(second) : Plane{};
      const VariableView values[] = {
          first, isPlane(surface.layer) ? VariableView(plane) : VariableView(pose)};
      cost += factor.cost(values);
    }
    return cost;
  }

  StoreyLab lab_;
  StoreyLab full_;  ///< The same, at its optimum.
};

TEST_F(WholeGraphTest, EndsAtTheOptimumOfTheFullGraph) {
  const double before = fullCost(lab_);
  const WholeGraphReport report = optimizeWholeGraph("condensed", exact(), &lab_.graph);
  EXPECT_TRUE(report.global.converged) << report.global.problem;
  EXPECT_NEAR(report.global.cost_before, before, 1e-9 * before);
  EXPECT_NEAR(report.global.cost_after, fullCost(full_), 1e-6 * fullCost(full_));
  EXPECT_NEAR(report.condensed_cost, report.global.cost_after, 2e-6 * fullCost(full_));
  expectTheFullOptimum();
}

TEST_F(WholeGraphTest, FindsItFromFarOff) {
  drift(&lab_.graph);
  const WholeGraphReport report = optimizeWholeGraph("condensed", exact(), &lab_.graph);
  EXPECT_GT(report.global.cost_before, 1e5);
  EXPECT_NEAR(report.global.cost_after, fullCost(full_), 1e-6 * fullCost(full_));
  expectTheFullOptimum();
}

TEST_F(WholeGraphTest, SaysWhatItDropped) {
  const WholeGraphReport report = optimizeWholeGraph("condensed", {}, &lab_.graph);
  std::size_t dropped = 0;
  for (uint64_t k = 0; k < lab_.truth.size(); ++k) {
    const KeyframeAttributes& keyframe = lab_.graph.attributes(KeyframeId{k});
    if (!keyframe.marginalized) continue;
    ++dropped;
    EXPECT_FALSE(lab_.graph.attributes(*keyframe.representative).marginalized);
    EXPECT_EQ(lab_.graph.factorCountOf(KeyframeId{k}), 0U);
  }
  EXPECT_EQ(report.dropped, dropped);
  EXPECT_EQ(report.active + dropped, lab_.truth.size());
  EXPECT_GT(dropped, lab_.truth.size() / 2);
  EXPECT_EQ(report.visit_ms.size(), 4U);  // two rooms, twice
}

TEST_F(WholeGraphTest, IsTheSameEveryTime) {
  StoreyLab other;
  fill(&other);
  optimizeWholeGraph("condensed", {}, &lab_.graph);
  optimizeWholeGraph("condensed", {}, &other.graph);
  for (uint64_t k = 0; k < lab_.truth.size(); ++k) {
    EXPECT_EQ(lab_.graph.pose(KeyframeId{k}).matrix(), other.graph.pose(KeyframeId{k}).matrix());
  }
}

TEST_F(WholeGraphTest, ByTheLetterOnlyTheFirstKeyframesOfRoomsAreLeftInThem) {
  const WholeGraphReport report = optimizeWholeGraph("paper", {}, &lab_.graph);
  for (const auto place : {StoreyLab::kFirst, StoreyLab::kSecond}) {
    for (const KeyframeId id : lab_.keyframes[place]) {
      EXPECT_EQ(lab_.graph.attributes(id).marginalized, id != lab_.keyframes[place].front());
    }
  }
  for (const KeyframeId id : lab_.keyframes[StoreyLab::kCorridor]) {
    EXPECT_FALSE(lab_.graph.attributes(id).marginalized);
  }
  EXPECT_EQ(report.condensed, 4U);  // a bridge for each stay
  EXPECT_EQ(report.rounds, 1);
  EXPECT_GT(report.global.cost_after, fullCost(full_));  // what was dropped is lost
  EXPECT_LT(report.global.cost_after, report.global.cost_before);
}

TEST_F(WholeGraphTest, KnowsItsModes) {
  EXPECT_THROW(optimizeWholeGraph("baseline", {}, &lab_.graph), std::invalid_argument);
}

TEST_F(WholeGraphTest, AnEmptyGraphStaysEmpty) {
  LayeredGraph nothing;
  EXPECT_EQ(optimizeWholeGraph("condensed", {}, &nothing).dropped, 0U);
  EXPECT_EQ(optimizeWholeGraph("paper", {}, &nothing).active, 0U);
}

TEST_F(WholeGraphTest, OfEachFactorBetweenRegionsOneEndStays) {
  std::map<KeyframeId, std::pair<std::optional<RoomId>, KeyframeId>> region_of;
  for (const RegionPlan& plan : planWholeGraph(lab_.graph, 4)) {
    EXPECT_FALSE(plan.dropped.empty());
    EXPECT_FALSE(plan.stay.empty());
    if (!plan.room) EXPECT_LE(plan.dropped.size(), 3U);
    for (const KeyframeId id : plan.dropped) {
      EXPECT_EQ(lab_.graph.attributes(id).room, plan.room);
      EXPECT_TRUE(region_of.emplace(id, std::pair(plan.room, plan.kept)).second);
    }
  }
  for (const StoredFactor& stored : lab_.graph.snapshot()->factors) {
    const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
    if (edge == nullptr) continue;
    const auto a = region_of.find({edge->node(0).value});
    const auto b = region_of.find({edge->node(1).value});
    if (a != region_of.end() && b != region_of.end()) {
      EXPECT_EQ(a->second, b->second);
    }
  }
}

TEST_F(WholeGraphTest, WhatIsHeldByTheMapStays) {
  const KeyframeId held = lab_.keyframes[StoreyLab::kFirst][4];
  lab_.graph.addFactor(
      std::make_shared<PosePriorFactor>(held, lab_.graph.pose(held), Matrix6::Identity()));
  for (const RegionPlan& plan : planWholeGraph(lab_.graph, 20)) {
    EXPECT_EQ(std::count(plan.dropped.begin(), plan.dropped.end(), held), 0);
  }
}

TEST(PutTogether, FollowsEdgesAndCondensedFactors) {
  LayeredGraph graph;
  test::RandomGeometry random(3);
  Pose T_a_b = random.smallPose(2.0, 0.5);
  Pose T_b_c = random.smallPose(2.0, 0.5);
  const Plane wall_b{Eigen::Vector3d::UnitX(), -2.0};
  const Pose T_map_a = random.smallPose(5.0, 1.0);
  const KeyframeId a = graph.addKeyframe(T_map_a, {});
  const KeyframeId b = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId c = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId alone = graph.addKeyframe(T_b_c, {});
  const WallId wall = graph.addWall(Plane{}, {});
  graph.addFactor(std::make_shared<RelativePoseFactor>(b, a, T_a_b.inverse(), Matrix6::Identity()));
  const CondensedFactor::Quadratic quadratic{Eigen::MatrixXd::Identity(9, 9),
                                             Eigen::VectorXd::Zero(9), 0.0};
  // the kept one is reached by the other
  graph.addFactor(std::make_shared<CondensedFactor>(
      c,
      std::vector<CondensedFactor::Other>{{b, T_b_c.inverse()},
                                          {wall, inverseTimes(T_b_c, wall_b)}},
      quadratic));

  putTogether(&graph);
  EXPECT_EQ(graph.pose(a).matrix(), T_map_a.matrix());
  EXPECT_LT((graph.pose(b).matrix() - (T_map_a * T_a_b).matrix()).norm(), 1e-12);
  EXPECT_LT((graph.pose(c).matrix() - (T_map_a * T_a_b * T_b_c).matrix()).norm(), 1e-12);
  EXPECT_EQ(graph.pose(alone).matrix(), T_b_c.matrix());
  EXPECT_LT(local(graph.plane(wall), T_map_a * T_a_b * wall_b).norm(), 1e-12);
}

}  // namespace
}  // namespace mrpt_sgraphs
