// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/map_cloud.h"

#include <gtest/gtest.h>

namespace mrpt_sgraphs {
namespace {

/// Two keyframes that see the same points, from 5 m apart.
GraphSnapshot twoViews() {
  GraphSnapshot graph;
  for (int k = 0; k < 2; ++k) {
    Cloud::Ptr cloud(new Cloud);
    for (int i = 0; i < 100; ++i) {
      Point point;
      point.getVector3fMap() << 0.1F * static_cast<float>(i) + 0.05F - 5.0F * static_cast<float>(k),
          2.05F, 0.05F;
      cloud->push_back(point);
    }
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{static_cast<uint64_t>(k)};
    keyframe.T_map_base.translation().x() = 5.0 * k;
    keyframe.cloud = cloud;
    graph.keyframes.push_back(keyframe);
  }
  return graph;
}

TEST(MapCloud, KeepsOnePointAVoxelOfWhatBothSee) {
  EXPECT_EQ(mapCloud(twoViews(), 0.1)->size(), 100U);
  EXPECT_EQ(mapCloud(twoViews(), 1.0)->size(), 10U);
  EXPECT_EQ(mapCloud(twoViews(), 0.0)->size(), 200U) << "no resolution: every point";
}

TEST(MapCloud, KeyframesWithoutACloudAddNothing) {
  GraphSnapshot graph = twoViews();
  graph.keyframes.edit(0).cloud.reset();
  EXPECT_EQ(mapCloud(graph, 0.0)->size(), 100U);
}

TEST(MapCloud, FollowsThePoses) {
  GraphSnapshot graph = twoViews();
  graph.keyframes.pop_back();
  graph.keyframes.edit(0).T_map_base.translation().z() = 7.0;
  const Cloud::ConstPtr map = mapCloud(graph, 0.1);
  for (const Point& point : *map) EXPECT_NEAR(point.z, 7.05F, 1e-5);
}

}  // namespace
}  // namespace mrpt_sgraphs
