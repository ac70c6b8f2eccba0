// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/occupancy_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "map_world.h"
#include "mrpt_sgraphs/mapping/octree.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using test::at;
using test::evidenceIn;
using test::keyframeAt;
using test::knownIn;
using test::roomOf6by4;
using test::walkThrough;

TEST(OccupancyMap, RoomIsFreeAndItsWallsAreOccupied) {
  OccupancyMap map{MapConfig{}};
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(map.update(walkThrough(roomOf6by4(), 3)));
  EXPECT_LT(map.evidenceAt({30, 20, 7}), 0);
  EXPECT_GT(map.evidenceAt({60, 20, 7}), 0) << "the wall at x = 6";
  EXPECT_EQ(map.evidenceAt({70, 20, 7}), 0) << "behind it";
  EXPECT_EQ(map.size(), knownIn(map).size());
}

TEST(OccupancyMap, NothingNewIsNothingToDo) {
  const GraphSnapshot graph = walkThrough(roomOf6by4(), 3);
  OccupancyMap map{MapConfig{}};
  EXPECT_TRUE(map.update(graph));
  EXPECT_FALSE(map.update(graph));
}

TEST(OccupancyMap, AQuarterOfACellIsNoMotionAndMoreIs) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 3);
  OccupancyMap map{MapConfig{}};
  map.update(graph);
  graph.keyframes.edit(1).T_map_base.translation().x() += 0.02;
  EXPECT_FALSE(map.update(graph));
  graph.keyframes.edit(1).T_map_base.translation().x() += 0.01;
  EXPECT_TRUE(map.update(graph));
  graph.keyframes.edit(0).T_map_base = graph.keyframes[0].T_map_base * at(0, 0, 0, 0.01);
  EXPECT_TRUE(map.update(graph)) << "5 cm at a range of 5 m";
}

TEST(OccupancyMap, WhatHasMovedGoneOrChangedLeavesNoTrace) {
  test::RandomGeometry random(3, 1.0);
  GraphSnapshot graph = walkThrough(roomOf6by4(), 8, 0.02);
  OccupancyMap map{MapConfig{}};
  map.update(graph);
  for (int round = 0; round < 5; ++round) {
    for (std::size_t k = 0; k < graph.keyframes.size(); k += 2) {
      Tangent motion;
      motion << Eigen::Vector3d(0.2, 0.0, 0.0) + 0.1 * random.vector(1.0), 0.2 * random.vector(1.0);
      KeyframeNode& keyframe = graph.keyframes.edit(k);
      keyframe.T_map_base = keyframe.T_map_base * expPose(motion);
    }
    if (round == 1) graph.keyframes.edit(3).cloud = graph.keyframes[5].cloud;
    if (round == 2) graph.keyframes.edit(5).cloud.reset();
    if (round == 3) graph.keyframes.pop_back();
    EXPECT_TRUE(map.update(graph));
    OccupancyMap anew{MapConfig{}};
    anew.update(graph);
    EXPECT_EQ(evidenceIn(map), evidenceIn(anew)) << round;
    EXPECT_EQ(map.bytes(), anew.bytes()) << "blocks of which nothing is known";
  }
  EXPECT_TRUE(map.update(GraphSnapshot{}));
  EXPECT_TRUE(map.empty());
}

/// Half a metre of drift, as a loop closure finds it: keyframes on the way back see the room
/// displaced, and are put right.
TEST(OccupancyMap, AfterALoopClosureThereIsOneWallAndNotTwo) {
  const GraphSnapshot right = walkThrough(roomOf6by4(), 10);
  GraphSnapshot drifted = right;
  for (std::size_t k = 5; k < 10; ++k) {
    drifted.keyframes.edit(k).T_map_base.translation() += Eigen::Vector3d(0.35, 0.35, 0.0);
  }
  const auto farthest_m = [](const OccupancyMap& map) {
    double farthest = 0.0;
    map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
      if (!is_occupied) return;
      const Eigen::Vector3d p = map.centreOf(voxel);
      const Eigen::Vector3d low = p.cwiseAbs();
      const Eigen::Vector3d high = (Eigen::Vector3d(6.0, 4.0, 2.6) - p).cwiseAbs();
      farthest = std::max(farthest, std::min(low.minCoeff(), high.minCoeff()));
    });
    return farthest;
  };
  OccupancyMap map{MapConfig{}};
  map.update(drifted);
  EXPECT_GT(farthest_m(map), 0.25);
  map.update(right);
  EXPECT_LT(farthest_m(map), 0.1);
  OccupancyMap anew{MapConfig{}};
  anew.update(right);
  EXPECT_EQ(evidenceIn(map), evidenceIn(anew));
}

TEST(OccupancyMap, WhatIsNoPlaceIsLeftOut) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 3);
  Cloud::Ptr cloud(new Cloud(*graph.keyframes[1].cloud));
  for (std::size_t k = 0; k < cloud->size(); k += 7) {
    (*cloud)[k].x = std::numeric_limits<float>::quiet_NaN();
  }
  graph.keyframes.edit(1).cloud = cloud;
  graph.keyframes.edit(2).T_map_base.translation().x() = 1e9;
  OccupancyMap map{MapConfig{}};
  map.update(graph);
  for (const auto& [voxel, is_occupied] : knownIn(map)) EXPECT_LT(std::abs(voxel[0]), 100);
  EXPECT_GT(map.size(), 1000U);
}

TEST(OctreeOf, IsTheMapCellByCellAfterWritingAndReading) {
  OccupancyMap map{MapConfig{}};
  map.update(walkThrough(roomOf6by4(), 5, 0.02));
  const auto tree = octreeOf(map);
  std::stringstream data;
  ASSERT_TRUE(tree->writeBinary(data));
  octomap::OcTree read(0.5);
  ASSERT_TRUE(read.readBinary(data));
  EXPECT_EQ(read.getResolution(), 0.1);
  EXPECT_LT(read.size(), map.size()) << "equal ones are joined";
  std::map<Voxel, bool> cells;
  read.expand();
  for (auto leaf = read.begin_leafs(); leaf != read.end_leafs(); ++leaf) {
    const octomap::OcTreeKey key = leaf.getKey();
    cells[{key[0] - 32768, key[1] - 32768, key[2] - 32768}] = read.isNodeOccupied(*leaf);
    const Eigen::Vector3d centre = map.centreOf({key[0] - 32768, key[1] - 32768, key[2] - 32768});
    EXPECT_NEAR(leaf.getX(), centre.x(), 1e-4);
  }
  EXPECT_EQ(cells, knownIn(map));
}

TEST(OctreeOf, NothingIsAnEmptyTree) {
  EXPECT_EQ(octreeOf(OccupancyMap{MapConfig{}})->size(), 0U);
}

}  // namespace
}  // namespace mrpt_sgraphs
