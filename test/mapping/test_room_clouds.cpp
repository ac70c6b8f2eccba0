// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/room_clouds.h"

#include <gtest/gtest.h>

#include "map_world.h"

namespace mrpt_sgraphs {
namespace {

using test::at;
using test::FlatWorld;
using test::keyframeAt;
using test::knownIn;
using test::roomOf6by4;
using test::walkThrough;

constexpr double kVoxel_m = 0.1;

/// All but the first are dropped, and move with it.
void drop(GraphSnapshot* graph) {
  for (std::size_t k = 1; k < graph->keyframes.size(); ++k) {
    graph->keyframes.edit(k).marginalized = true;
    graph->keyframes.edit(k).representative = graph->keyframes[0].id;
  }
}

std::size_t pointsOf(const GraphSnapshot& graph) {
  std::size_t points = 0;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (keyframe.cloud != nullptr) points += keyframe.cloud->size();
  }
  return points;
}

TEST(RoomClouds, WhatWasNotDroppedKeepsItsWholeCloud) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 3);
  const GraphSnapshot before = graph;
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(graph.keyframes[k].cloud, before.keyframes[k].cloud) << "the very same";
    EXPECT_FALSE(clouds.isThinned(KeyframeId{k}));
  }
}

/// As many visits as may be: what a room takes is bounded by its surfaces.
TEST(RoomClouds, MemoryFollowsTheAreaAndNotTheVisits) {
  RoomClouds clouds(kVoxel_m);
  const FlatWorld world = roomOf6by4();
  GraphSnapshot graph;
  std::size_t whole = 0;
  std::size_t after_visit[40] = {};
  for (std::size_t visit = 0; visit < 40; ++visit) {
    for (const KeyframeNode& seen : walkThrough(world, 5, 0.01).keyframes) {
      KeyframeNode keyframe = seen;
      keyframe.id = KeyframeId{graph.keyframes.size()};
      keyframe.T_map_base = seen.T_map_base * at(0.05, -0.03, 0.0, 0.7 * static_cast<double>(visit));
      keyframe.cloud = test::cloudOf(world, keyframe.T_map_base, 0.01,
                                     static_cast<unsigned>(keyframe.id.value));
      whole += keyframe.cloud->size();
      graph.keyframes.push_back(keyframe);
    }
    drop(&graph);
    GraphSnapshot thinned = graph;
    clouds.attachTo(&thinned);
    EXPECT_EQ(clouds.points(), pointsOf(thinned));
    after_visit[visit] = clouds.points();
    for (std::size_t k = 1; k < graph.keyframes.size(); ++k) {
      EXPECT_TRUE(clouds.isThinned(KeyframeId{k}));
      graph.keyframes.edit(k).cloud.reset();  // as the pipeline lets go of them
    }
  }
  EXPECT_LT(10 * clouds.points(), whole);
  EXPECT_LT(after_visit[39] - after_visit[29], (after_visit[9] - after_visit[0]) / 5);
}

TEST(RoomClouds, TheMapOfThemIsTheMapOfTheWholeClouds) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 12, 0.01);
  OccupancyMap whole{MapConfig{}};
  whole.update(graph);
  drop(&graph);
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  OccupancyMap thinned{MapConfig{}};
  thinned.update(graph);
  const auto known = knownIn(whole);
  std::size_t same = 0;
  std::size_t opposite = 0;
  for (const auto& [voxel, is_occupied] : known) {
    const int evidence = thinned.evidenceAt(voxel);
    if (evidence == 0) continue;
    ++((evidence > 0) == is_occupied ? same : opposite);
  }
  EXPECT_GT(static_cast<double>(same), 0.95 * static_cast<double>(known.size()));
  EXPECT_LT(static_cast<double>(opposite), 0.01 * static_cast<double>(known.size()));
}

TEST(RoomClouds, MovesWithTheRoom) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 6);
  drop(&graph);
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  OccupancyMap map{MapConfig{}};
  map.update(graph);

  const Pose motion = at(0.6, -0.4, 0.1, 0.0);  // whole cells
  GraphSnapshot moved = graph;
  for (std::size_t k = 0; k < 6; ++k) {
    KeyframeNode& keyframe = moved.keyframes.edit(k);
    keyframe.T_map_base = motion * keyframe.T_map_base;
    if (k > 0) keyframe.cloud.reset();
  }
  clouds.attachTo(&moved);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(moved.keyframes[k].cloud, graph.keyframes[k].cloud) << "thinned once";
  }
  map.update(moved);
  EXPECT_GT(map.evidenceAt({66, 20, 8}), 0) << "the wall at x = 6";
  EXPECT_LE(map.evidenceAt({60, 20, 8}), 0) << "where it was";
}

TEST(RoomClouds, WhatComesBackHasItsWholeCloudAndIsThinnedAgain) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 4);
  const GraphSnapshot whole = graph;
  drop(&graph);
  const GraphSnapshot dropped = graph;
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  const std::size_t thin = clouds.points();

  GraphSnapshot back = whole;
  clouds.attachTo(&back);
  EXPECT_EQ(clouds.points(), pointsOf(whole));
  GraphSnapshot again = dropped;
  clouds.attachTo(&again);
  EXPECT_EQ(clouds.points(), thin);
}

TEST(RoomClouds, OneThatComesBackAloneTakesNothingFromTheOthers) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 4);
  drop(&graph);
  const GraphSnapshot dropped = graph;
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  const std::size_t thin = clouds.points();
  GraphSnapshot back = graph;
  back.keyframes.edit(1).marginalized = false;
  back.keyframes.edit(1).representative.reset();
  back.keyframes.edit(1).cloud.reset();  // its whole cloud was let go of
  clouds.attachTo(&back);
  EXPECT_EQ(back.keyframes[1].cloud, graph.keyframes[1].cloud) << "what is left of it";
  GraphSnapshot again = dropped;
  for (std::size_t k = 1; k < 4; ++k) again.keyframes.edit(k).cloud.reset();
  clouds.attachTo(&again);
  EXPECT_EQ(clouds.points(), thin);
}

TEST(RoomClouds, WhatLeavesTheGraphIsForgotten) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 4);
  drop(&graph);
  RoomClouds clouds(kVoxel_m);
  clouds.attachTo(&graph);
  graph.keyframes.pop_back();
  clouds.attachTo(&graph);
  EXPECT_EQ(clouds.points(), pointsOf(graph));
  GraphSnapshot empty;
  clouds.attachTo(&empty);
  EXPECT_EQ(clouds.points(), 0U);
}

}  // namespace
}  // namespace mrpt_sgraphs
