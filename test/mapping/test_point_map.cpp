// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/point_map.h"

#include <gtest/gtest.h>

#include <set>

#include "map_world.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using test::roomOf6by4;
using test::walkThrough;

void expectSame(const Cloud& a, const Cloud& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].getVector3fMap(), b[k].getVector3fMap()) << k;
    ASSERT_EQ(a[k].intensity, b[k].intensity) << k;
  }
}

TEST(PointMap, HasOnePointAVoxelInTheMiddleOfItsPoints) {
  Cloud::Ptr cloud(new Cloud);
  for (const float x : {0.31F, 0.33F, 0.38F, -0.02F}) {
    Point point;
    point.getVector3fMap() << x, 0.25F, -0.05F;
    point.intensity = 100.0F * x;
    cloud->push_back(point);
  }
  GraphSnapshot graph;
  KeyframeNode keyframe;
  keyframe.cloud = cloud;
  keyframe.T_map_base.translation().y() = 1.0;
  graph.keyframes.push_back(keyframe);
  PointMap map(0.1);
  EXPECT_TRUE(map.update(graph));
  const Cloud::ConstPtr points = map.cloud();
  ASSERT_EQ(points->size(), 2U);
  EXPECT_NEAR((*points)[0].x, -0.02, 1e-4);
  EXPECT_NEAR((*points)[1].x, 0.34, 1e-4);
  EXPECT_NEAR((*points)[1].y, 1.25, 1e-4);
  EXPECT_NEAR((*points)[1].z, -0.05, 1e-4);
  EXPECT_NEAR((*points)[1].intensity, 34.0, 0.1);
}

TEST(PointMap, WhatHasMovedOrGoneLeavesNoTrace) {
  test::RandomGeometry random(5, 1.0);
  GraphSnapshot graph = walkThrough(roomOf6by4(), 6, 0.02);
  PointMap map(0.1);
  map.update(graph);
  for (int round = 0; round < 4; ++round) {
    for (std::size_t k = 1; k < graph.keyframes.size(); k += 2) {
      graph.keyframes.edit(k).T_map_base.translation() +=
          Eigen::Vector3d(0.2, 0.0, 0.0) + random.vector(0.1);
    }
    if (round == 2) graph.keyframes.pop_back();
    EXPECT_TRUE(map.update(graph));
    EXPECT_FALSE(map.update(graph));
    PointMap anew(0.1);
    anew.update(graph);
    expectSame(*map.cloud(), *anew.cloud());
  }
  map.update(GraphSnapshot{});
  EXPECT_TRUE(map.cloud()->empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
