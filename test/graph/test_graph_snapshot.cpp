// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <thread>

#include "graph_support.h"

namespace mrpt_sgraphs {
namespace {

Pose at(double x) { return Pose(Eigen::Translation3d(x, 0.0, 0.0)); }

/// A thousand keyframes in a row that see fifty walls.
LayeredGraph longWalk() {
  LayeredGraph graph;
  for (int k = 0; k < 50; ++k) graph.addWall({Eigen::Vector3d::UnitY(), 1.0 * k}, {});
  for (uint64_t k = 0; k < 1000; ++k) {
    const double x = static_cast<double>(k);
    const KeyframeId id = graph.addKeyframe(at(x), test::stamped(x));
    if (k > 0) graph.addFactor(test::odometry(KeyframeId{k - 1}, id, at(1.0)));
    graph.addFactor(test::sight(id, WallId{k % 50}));
  }
  return graph;
}

TEST(GraphSnapshot, IsTheSameObjectUntilSomethingChanges) {
  LayeredGraph graph = longWalk();
  GraphSnapshotConstPtr last = graph.snapshot();
  EXPECT_EQ(graph.snapshot(), last);
  const auto expectNew = [&](const char* after) {
    EXPECT_NE(graph.snapshot(), last) << after;
    last = graph.snapshot();
    EXPECT_EQ(graph.snapshot(), last) << after;
  };
  graph.setPose(KeyframeId{4}, at(0.0));
  expectNew("pose");
  graph.setPlane(WallId{4}, {Eigen::Vector3d::UnitX(), 0.0});
  expectNew("plane");
  graph.setAttributes(KeyframeId{4}, test::stamped(5.0));
  expectNew("attributes");
  graph.setMapOdom(at(1.0));
  expectNew("drift");
  graph.addRoom(at(1.0), {});
  expectNew("room");
  graph.eraseFactor(FactorId{3});
  expectNew("factor erased");
  graph.addFactor(test::odometry(KeyframeId{0}, KeyframeId{9}));
  expectNew("factor");
  graph.eraseNode(RoomId{0});
  expectNew("room erased");
}

TEST(GraphSnapshot, HasEverythingOfTheGraph) {
  LayeredGraph graph = longWalk();
  RoomAttributes room;
  room.walls = {WallId{1}, WallId{2}};
  graph.addRoom(at(3.0), room);
  graph.addFloor({Eigen::Vector3d::UnitZ(), 0.1}, {});
  graph.setMapOdom(at(0.2));
  graph.setPose(KeyframeId{999}, at(-5.0));
  const GraphSnapshotConstPtr snapshot = graph.snapshot();
  EXPECT_EQ(snapshot->stamp_s, 999.0);
  EXPECT_EQ(snapshot->T_map_odom.matrix(), at(0.2).matrix());
  ASSERT_EQ(snapshot->keyframes.size(), 1000U);
  EXPECT_EQ(snapshot->keyframes[998].id, KeyframeId{998});
  EXPECT_EQ(snapshot->keyframes[998].T_map_base.matrix(), at(998.0).matrix());
  EXPECT_EQ(snapshot->keyframes[999].T_map_base.matrix(), at(-5.0).matrix());
  EXPECT_EQ(snapshot->walls[7].plane_map.distance, 7.0);
  EXPECT_EQ(snapshot->rooms[0].walls, room.walls);
  EXPECT_EQ(snapshot->rooms[0].T_map_room.matrix(), at(3.0).matrix());
  EXPECT_EQ(snapshot->floors[0].ground_map.distance, 0.1);
  ASSERT_EQ(snapshot->factors.size(), graph.factorCount());
  EXPECT_EQ(snapshot->factors[5].factor, graph.factor(snapshot->factors[5].id));
}

TEST(GraphSnapshot, StaysAsItWas) {
  LayeredGraph graph = longWalk();
  const GraphSnapshotConstPtr before = graph.snapshot();
  const FactorConstPtr factor = before->factors[0].factor;
  for (uint64_t k = 0; k < 1000; ++k) graph.setPose(KeyframeId{k}, at(-1.0));
  graph.setPlane(WallId{0}, {Eigen::Vector3d::UnitX(), -1.0});
  for (uint64_t k = 0; k < 1000; k += 2) graph.eraseNode(KeyframeId{k});
  ASSERT_EQ(before->keyframes.size(), 1000U);
  for (std::size_t k = 0; k < 1000; ++k) {
    ASSERT_EQ(before->keyframes[k].T_map_base.translation().x(), static_cast<double>(k));
  }
  EXPECT_EQ(before->walls[0].plane_map.distance, 0.0);
  EXPECT_EQ(before->factors.size(), 1999U);
  EXPECT_EQ(before->factors[0].factor, factor);
  EXPECT_EQ(graph.snapshot()->keyframes.size(), 500U);
}

TEST(GraphSnapshot, CostsWhatHasChanged) {
  LayeredGraph graph = longWalk();
  const GraphSnapshotConstPtr before = graph.snapshot();
  graph.setPose(KeyframeId{300}, at(0.0));
  graph.setPose(KeyframeId{301}, at(0.0));
  const GraphSnapshotConstPtr moved = graph.snapshot();
  EXPECT_EQ(moved->keyframes.chunkCount(), 4U);
  EXPECT_EQ(moved->keyframes.chunksSharedWith(before->keyframes), 3U);
  EXPECT_EQ(moved->walls.chunksSharedWith(before->walls), moved->walls.chunkCount());
  EXPECT_EQ(moved->factors.chunksSharedWith(before->factors), moved->factors.chunkCount());

  graph.addFactor(test::odometry(KeyframeId{0}, KeyframeId{9}));
  const GraphSnapshotConstPtr joined = graph.snapshot();
  EXPECT_EQ(joined->keyframes.chunksSharedWith(moved->keyframes), 4U);
  EXPECT_EQ(joined->factors.chunksSharedWith(moved->factors), joined->factors.chunkCount() - 1);
}

TEST(GraphSnapshot, IsReadInAnotherThreadWhileTheGraphGoesOn) {
  LayeredGraph graph = longWalk();
  for (int round = 0; round < 20; ++round) {
    for (uint64_t k = 0; k < 1000; ++k) graph.setPose(KeyframeId{k}, at(round));
    GraphSnapshotConstPtr snapshot = graph.snapshot();
    int others = 0;
    std::thread reader([&others, round, snapshot = std::move(snapshot)]() mutable {
      for (const KeyframeNode& keyframe : snapshot->keyframes) {
        others += keyframe.T_map_base.translation().x() == round ? 0 : 1;
      }
      snapshot.reset();
    });
    for (uint64_t k = 0; k < 1000; ++k) graph.setPose(KeyframeId{k}, at(-1.0));
    graph.snapshot();
    reader.join();
    ASSERT_EQ(others, 0) << round;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
