// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/hierarchy/compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "support/storey_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::StoreyLab;

HierarchyConfig condensing() {
  HierarchyConfig config;
  config.local_keyframes = 2;
  return config;
}

int condensedFactorsOf(const LayeredGraph& graph) {
  int count = 0;
  for (const StoredFactor& stored : graph.snapshot()->factors) {
    if (dynamic_cast<const CondensedFactor*>(stored.factor.get()) != nullptr) ++count;
  }
  return count;
}

int droppedOf(const LayeredGraph& graph) {
  int count = 0;
  for (const KeyframeNode& keyframe : graph.snapshot()->keyframes) {
    count += keyframe.marginalized ? 1 : 0;
  }
  return count;
}

void compressAll(Compression* compression, LayeredGraph* graph) {
  for (const RegionPlan& plan : compression->due(*graph, true)) compression->apply(plan, graph);
}

OptimizerConfig exact() {
  OptimizerConfig config;
  config.min_relative_decrease = 1e-14;
  return config;
}

void optimize(Compression* compression, LayeredGraph* graph) {
  Optimizer optimizer;
  compression->followers().optimize(selectAll(*graph), exact(), &optimizer, graph);
}

/// A tour, compressed at its optimum or near it, beside the same one that is not.
class CompressionTest : public ::testing::Test {
 protected:
  CompressionTest() {
    full_.tour();
    full_.optimize();
    lab_.tour();
    lab_.optimize();
  }

  void expectAsFull(double tolerance) {
    for (std::size_t k = 0; k < lab_.truth.size(); ++k) {
      const KeyframeId id{k};
      EXPECT_LE(local(full_.graph.pose(id), lab_.graph.pose(id)).norm(), tolerance) << k;
    }
    for (const auto& walls : lab_.walls) {
      for (const WallId wall : walls) {
        EXPECT_LE(local(full_.graph.plane(wall), lab_.graph.plane(wall)).norm(), tolerance);
      }
    }
  }

  StoreyLab full_;
  StoreyLab lab_;
  Compression compression_{condensing()};
};

TEST_F(CompressionTest, ARoomKeepsItsFirstKeyframeAndOneFactor) {
  compressAll(&compression_, &lab_.graph);
  // the corridor keeps the first one of all; rooms are entered at their first and left by the same
  // door; the two newest are still in the window
  EXPECT_EQ(condensedFactorsOf(lab_.graph), 3);
  EXPECT_EQ(droppedOf(lab_.graph), static_cast<int>(lab_.truth.size()) - 3 - 2);
  for (const int place : {StoreyLab::kFirst, StoreyLab::kSecond}) {
    const KeyframeId first = lab_.keyframes[place].front();
    for (const KeyframeId id : lab_.keyframes[place]) {
      const KeyframeAttributes& keyframe = lab_.graph.attributes(id);
      EXPECT_EQ(keyframe.marginalized, id != first);
      if (id != first) {
        EXPECT_EQ(keyframe.representative, first);
      }
    }
  }
  EXPECT_EQ(compression_.followers().count(), static_cast<std::size_t>(droppedOf(lab_.graph)));
}

TEST_F(CompressionTest, LosesNearlyNothing) {
  compressAll(&compression_, &lab_.graph);
  optimize(&compression_, &lab_.graph);
  compression_.resolve(exact(), &lab_.graph);
  // ways out of a room by the door that it was entered by are transferred: half the sigma of one step
  expectAsFull(0.011);
}

TEST_F(CompressionTest, LosesNothingWhereEachPassageIsKept) {
  HierarchyConfig config = condensing();
  config.max_passages = 10;
  Compression all_kept(config);
  compressAll(&all_kept, &lab_.graph);
  EXPECT_EQ(condensedFactorsOf(lab_.graph), 3);
  EXPECT_EQ(droppedOf(lab_.graph), static_cast<int>(lab_.truth.size()) - 5 - 2);
  // from somewhere else back to where the full graph has it
  test::RandomGeometry random(3);
  const GraphSnapshotConstPtr compressed = lab_.graph.snapshot();
  for (const KeyframeNode& keyframe : compressed->keyframes) {
    if (keyframe.marginalized || keyframe.id.value == 0) continue;
    lab_.graph.setPose(keyframe.id, keyframe.T_map_base * random.smallPose(0.01, 0.005));
  }
  optimize(&all_kept, &lab_.graph);
  all_kept.resolve(exact(), &lab_.graph);
  expectAsFull(1e-5);
}

TEST_F(CompressionTest, AnotherVisitFoldsIntoTheSameFactor) {
  compressAll(&compression_, &lab_.graph);
  std::vector<int> active;
  std::vector<std::size_t> factors;
  for (int tour = 0; tour < 4; ++tour) {
    lab_.tour();
    optimize(&compression_, &lab_.graph);
    compressAll(&compression_, &lab_.graph);
    EXPECT_EQ(condensedFactorsOf(lab_.graph), 3);
    active.push_back(static_cast<int>(lab_.truth.size()) - droppedOf(lab_.graph));
    factors.push_back(lab_.graph.factorCount());
  }
  EXPECT_LE(active.back(), active[1]);
  EXPECT_LE(factors.back(), factors[1] + 2);

  for (int tour = 0; tour < 4; ++tour) full_.tour();
  full_.optimize();
  optimize(&compression_, &lab_.graph);
  compression_.resolve(exact(), &lab_.graph);
  expectAsFull(0.011);
}

TEST_F(CompressionTest, AnEdgeBetweenRoomsIsTransferred) {
  const KeyframeId first = lab_.keyframes[StoreyLab::kFirst][4];
  const KeyframeId second = lab_.keyframes[StoreyLab::kSecond][4];
  const FactorId loop = lab_.close(first, second);
  full_.close(first, second);
  full_.optimize();
  compressAll(&compression_, &lab_.graph);
  EXPECT_TRUE(lab_.graph.shelf().contains(loop));
  EXPECT_FALSE(lab_.graph.shelf().at(loop).kept.has_value());
  int bridges = 0;
  for (const StoredFactor& stored : lab_.graph.snapshot()->factors) {
    const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
    if (edge == nullptr || edge->kind != RelativePoseFactor::Kind::kBridge) continue;
    ++bridges;
    EXPECT_EQ(edge->node(0), NodeId(lab_.keyframes[StoreyLab::kFirst].front()));
    // no more is known than before
    EXPECT_GT(edge->information().inverse().trace(), 3.0 / 2500.0 + 3.0 / 4e4);
  }
  EXPECT_LE(bridges, 1);
  optimize(&compression_, &lab_.graph);
  compression_.resolve(exact(), &lab_.graph);
  expectAsFull(0.011);
}

TEST_F(CompressionTest, WhatIsErasedLaterIsTakenOut) {
  compressAll(&compression_, &lab_.graph);
  const WallId wall = lab_.walls[StoreyLab::kFirst][1];
  lab_.graph.eraseNode(wall);
  full_.graph.eraseNode(wall);
  EXPECT_TRUE(compression_.mend(&lab_.graph));
  EXPECT_FALSE(compression_.mend(&lab_.graph));
  EXPECT_EQ(condensedFactorsOf(lab_.graph), 3);
  for (const StoredFactor& stored : lab_.graph.snapshot()->factors) {
    for (int k = 0; k < stored.factor->nodeCount(); ++k) {
      EXPECT_NE(stored.factor->node(k), NodeId(wall));
    }
  }
  full_.optimize();
  optimize(&compression_, &lab_.graph);
  compression_.resolve(exact(), &lab_.graph);
  for (std::size_t k = 0; k < lab_.truth.size(); ++k) {
    EXPECT_LE(local(full_.graph.pose(KeyframeId{k}), lab_.graph.pose(KeyframeId{k})).norm(), 0.011);
  }
}

TEST_F(CompressionTest, ASightOfADroppedKeyframeThatComesLateCounts) {
  compressAll(&compression_, &lab_.graph);
  const KeyframeId dropped = lab_.keyframes[StoreyLab::kFirst][3];
  const Plane seen = lab_.graph.pose(dropped).inverse() * Plane{{0.0, 1.0, 0.0}, -40.0};
  for (StoreyLab* lab : {&full_, &lab_}) {
    const WallId wall = lab->graph.addWall(Plane{{0.0, 1.0, 0.0}, -40.0}, {});
    lab->graph.addFactor(std::make_shared<PlaneObservationFactor>(
        dropped, wall, seen, 1e4 * Eigen::Matrix3d::Identity()));
  }
  EXPECT_TRUE(compression_.mend(&lab_.graph));
  EXPECT_TRUE(lab_.graph.sightingsOf(dropped).empty());
  full_.optimize();
  optimize(&compression_, &lab_.graph);
  compression_.resolve(exact(), &lab_.graph);
  expectAsFull(0.011);
}

TEST_F(CompressionTest, DroppedKeyframesMoveWithTheirRoom) {
  compressAll(&compression_, &lab_.graph);
  const KeyframeId kept = lab_.keyframes[StoreyLab::kSecond].front();
  const KeyframeId dropped = lab_.keyframes[StoreyLab::kSecond][5];
  const Pose T_kept_dropped = lab_.graph.pose(kept).inverse() * lab_.graph.pose(dropped);
  const Pose goal = lab_.graph.pose(kept) * expPose((Tangent() << 0.5, 0.2, 0.0, 0.0, 0.0, 0.1).finished());
  lab_.connect(KeyframeId{0}, kept, lab_.graph.pose(KeyframeId{0}).inverse() * goal,
               RelativePoseFactor::Kind::kLoopClosure);
  optimize(&compression_, &lab_.graph);
  EXPECT_GT(local(lab_.graph.pose(kept), full_.graph.pose(kept)).norm(), 0.01);
  EXPECT_LE(local(T_kept_dropped, lab_.graph.pose(kept).inverse() * lab_.graph.pose(dropped)).norm(),
            1e-12);
}

TEST_F(CompressionTest, EverythingComesBackOnRequest) {
  const GraphSnapshotConstPtr before = lab_.graph.snapshot();
  compressAll(&compression_, &lab_.graph);
  EXPECT_LT(lab_.graph.factorCount(), before->factors.size() / 3);
  compression_.restore(&lab_.graph);
  EXPECT_EQ(droppedOf(lab_.graph), 0);
  const GraphSnapshotConstPtr after = lab_.graph.snapshot();
  EXPECT_EQ(after->shelved.size(), 0U);
  std::map<FactorId, const Factor*> factors;
  for (const StoredFactor& stored : before->factors) factors[stored.id] = stored.factor.get();
  ASSERT_EQ(after->factors.size(), factors.size());
  for (const StoredFactor& stored : after->factors) {
    ASSERT_EQ(factors.count(stored.id), 1U);
    EXPECT_EQ(factors.at(stored.id), stored.factor.get());
  }
  lab_.optimize();
  expectAsFull(1e-6);
}

TEST_F(CompressionTest, ThicknessOfWallsIsKeptAtTheKeptKeyframe) {
  const KeyframeId at = lab_.keyframes[StoreyLab::kFirst][4];
  const auto pair = std::make_shared<WallPairFactor>(
      at, lab_.walls[StoreyLab::kFirst][1], lab_.walls[StoreyLab::kSecond][0],
      lab_.graph.pose(at).inverse().linear() * lab_.graph.plane(lab_.walls[StoreyLab::kFirst][1]).normal,
      -0.3, 400.0 * Eigen::Matrix3d::Identity());
  const FactorId id = lab_.graph.addFactor(pair);
  const auto residual = [&] {
    const auto& now = dynamic_cast<const WallPairFactor&>(*lab_.graph.factor(id));
    return now
        .evaluate(lab_.graph.pose(KeyframeId{now.node(0).value}),
                  lab_.graph.plane(WallId{now.node(1).value}),
                  lab_.graph.plane(WallId{now.node(2).value}), nullptr, nullptr, nullptr)
        .norm();
  };
  const double before = residual();
  compressAll(&compression_, &lab_.graph);
  EXPECT_EQ(lab_.graph.factor(id)->node(0), NodeId(lab_.keyframes[StoreyLab::kFirst].front()));
  EXPECT_NEAR(residual(), before, 1e-9);
}

TEST_F(CompressionTest, WhatIsInNoRoomIsDividedAmongKeptKeyframes) {
  for (const KeyframeId id : lab_.keyframes[StoreyLab::kCorridor]) {
    KeyframeAttributes attributes = lab_.graph.attributes(id);
    attributes.room.reset();
    lab_.graph.setAttributes(id, attributes);
  }
  compressAll(&compression_, &lab_.graph);
  const HierarchyConfig config;
  int kept = 0;
  for (const KeyframeId id : lab_.keyframes[StoreyLab::kCorridor]) {
    const KeyframeAttributes& keyframe = lab_.graph.attributes(id);
    kept += keyframe.marginalized ? 0 : 1;
    if (!keyframe.marginalized) continue;
    const double distance_m = (lab_.graph.pose(id).translation() -
                               lab_.graph.pose(*keyframe.representative).translation())
                                  .norm();
    EXPECT_LE(distance_m, config.region_radius_m);
  }
  EXPECT_GT(kept, 2);
  EXPECT_LT(kept, static_cast<int>(lab_.keyframes[StoreyLab::kCorridor].size()) - 8);
}

TEST_F(CompressionTest, LooksOnlyWhenEnoughHasCome) {
  compressAll(&compression_, &lab_.graph);
  EXPECT_TRUE(compression_.due(lab_.graph, false).empty());
  HierarchyConfig baseline;
  baseline.mode = "baseline";
  EXPECT_TRUE(Compression(baseline).due(lab_.graph, true).empty());
}

// Sec. III-B to the letter, on a chain 0 - 1 - 2 - 3 - 4 that a loop joins to 5.
TEST(PaperCompression, BridgesWithTheSumOfWhatIsGone) {
  LayeredGraph graph;
  std::vector<Matrix6> information;
  const WallId wall = graph.addWall(Plane{{1.0, 0.0, 0.0}, 9.0}, {});
  for (int k = 0; k < 6; ++k) {
    KeyframeAttributes attributes;
    attributes.stamp_s = k;
    Pose T = Pose::Identity();
    T.translation() << k, 0.1 * k * k, 0.0;
    if (k == 5) T.translation() << 2.0, 3.0, 0.0;
    graph.addKeyframe(T, attributes);
    graph.addFactor(std::make_shared<PlaneObservationFactor>(
        KeyframeId{static_cast<uint64_t>(k)}, wall, inverseTimes(T, graph.plane(wall)),
        Eigen::Matrix3d::Identity()));
  }
  const auto join = [&](uint64_t from, uint64_t to) {
    information.push_back(static_cast<double>(information.size() + 1) * Matrix6::Identity());
    const Pose T = graph.pose(KeyframeId{from}).inverse() * graph.pose(KeyframeId{to});
    graph.addFactor(std::make_shared<RelativePoseFactor>(KeyframeId{from}, KeyframeId{to}, T,
                                                         information.back()));
  };
  for (uint64_t k = 0; k < 4; ++k) join(k, k + 1);  // 1, 2, 3, 4
  join(2, 5);                                        // 5

  marginalizeByTheLetter(KeyframeId{0}, {KeyframeId{1}, KeyframeId{2}, KeyframeId{3}}, &graph);
  std::map<std::pair<uint64_t, uint64_t>, const RelativePoseFactor*> bridges;
  int sightings = 0;
  for (const StoredFactor& stored : graph.snapshot()->factors) {
    if (const RelativePoseFactor* const edge = keyframeEdge(*stored.factor)) {
      EXPECT_EQ(edge->kind, RelativePoseFactor::Kind::kBridge);
      bridges[{edge->node(0).value, edge->node(1).value}] = edge;
    } else {
      ++sightings;
    }
  }
  // 0, 4 and 5 remain: 0 - 5 are 3.6 m apart, 4 - 5 are 2.4 m, 0 - 4 are 4.3 m
  ASSERT_EQ(bridges.size(), 2U);
  ASSERT_EQ(bridges.count({0, 5}) + bridges.count({4, 5}), 2U);
  EXPECT_EQ(sightings, 3);
  EXPECT_EQ(graph.shelf().all().size(), 8U);
  for (const auto& [ends, bridge] : bridges) {
    EXPECT_EQ(bridge->information(), 15.0 * Matrix6::Identity());
    const Pose expected =
        graph.pose(KeyframeId{ends.first}).inverse() * graph.pose(KeyframeId{ends.second});
    EXPECT_LE(local(expected, bridge->T_from_to).norm(), 1e-12);
  }
}

TEST(PaperCompression, KeepsTheFirstKeyframeOfARoomAndDropsTheRest) {
  StoreyLab lab;
  lab.tour();
  lab.optimize();
  HierarchyConfig config = condensing();
  config.mode = "paper";
  Compression compression(config);
  compressAll(&compression, &lab.graph);
  std::set<KeyframeId> kept;
  for (const KeyframeNode& keyframe : lab.graph.snapshot()->keyframes) {
    if (!keyframe.marginalized) kept.insert(keyframe.id);
  }
  const KeyframeId newest{lab.truth.size() - 1};
  EXPECT_EQ(kept, (std::set<KeyframeId>{KeyframeId{0}, lab.keyframes[StoreyLab::kFirst].front(),
                                        lab.keyframes[StoreyLab::kSecond].front(), newest}));
  EXPECT_EQ(condensedFactorsOf(lab.graph), 0);
  EXPECT_TRUE(lab.optimize().converged);
  compression.restore(&lab.graph);
  EXPECT_EQ(droppedOf(lab.graph), 0);
}

}  // namespace
}  // namespace mrpt_sgraphs
