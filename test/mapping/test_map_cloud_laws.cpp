// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "mrpt_sgraphs/mapping/map_cloud.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using Voxel = std::array<long, 3>;

Voxel voxelOf(const Eigen::Vector3d& p, double edge_m) {
  return {std::lround(std::floor(p.x() / edge_m)), std::lround(std::floor(p.y() / edge_m)),
          std::lround(std::floor(p.z() / edge_m))};
}

/// Keyframes anywhere, each with points all about it.
GraphSnapshot scattered(const Pose& T_other_map = Pose::Identity()) {
  test::RandomGeometry random(9, 5.0);
  GraphSnapshot graph;
  graph.stamp_s = 1234.5;
  for (int k = 0; k < 5; ++k) {
    Cloud::Ptr cloud(new Cloud);
    for (int i = 0; i < 2000; ++i) {
      Point point;
      point.getVector3fMap() = random.vector(4.0).cast<float>();
      point.intensity = static_cast<float>(k);
      point.ring = static_cast<std::uint16_t>(i % 16);
      point.time = 0.05F;
      cloud->push_back(point);
    }
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{static_cast<std::uint64_t>(k)};
    keyframe.T_map_base = T_other_map * random.pose();
    keyframe.cloud = cloud;
    graph.keyframes.push_back(keyframe);
  }
  return graph;
}

TEST(MapCloudLaws, EveryPointIsInAVoxelOfItsOwnAndEveryVoxelHasItsPoint) {
  const GraphSnapshot graph = scattered();
  for (const double resolution_m : {0.25, 0.5, 2.0}) {  // exact in floats
    std::set<Voxel> seen;
    for (const KeyframeNode& keyframe : graph.keyframes) {
      for (const Point& point : *keyframe.cloud) {
        const Eigen::Vector3d p = keyframe.T_map_base * point.getVector3fMap().cast<double>();
        seen.insert(voxelOf(p.cast<float>().cast<double>(), resolution_m));
      }
    }
    std::set<Voxel> kept;
    const Cloud::Ptr map = mapCloud(graph, resolution_m);
    for (const Point& point : *map) {
      const Voxel voxel = voxelOf(point.getVector3fMap().cast<double>(), resolution_m);
      EXPECT_TRUE(kept.insert(voxel).second);
    }
    EXPECT_EQ(kept, seen) << resolution_m;
  }
}

TEST(MapCloudLaws, PointsAreThoseOfTheKeyframesAtTheirPoses) {
  const GraphSnapshot graph = scattered();
  const Cloud::Ptr map = mapCloud(graph, 0.0);
  EXPECT_NEAR(stampOf(*map), graph.stamp_s, 1e-6);
  ASSERT_EQ(map->size(), 10000U);
  for (std::size_t i = 0; i < map->size(); ++i) {
    const Point& placed = (*map)[i];
    const KeyframeNode& keyframe = graph.keyframes[i / 2000];
    const Point& original = (*keyframe.cloud)[i % 2000];
    const Eigen::Vector3d p = keyframe.T_map_base * original.getVector3fMap().cast<double>();
    ASSERT_LT((placed.getVector3fMap().cast<double>() - p).norm(), 1e-5);
    ASSERT_EQ(placed.intensity, original.intensity);
    ASSERT_EQ(placed.ring, original.ring);
    ASSERT_EQ(placed.time, 0.0F) << "a map has no sweep";
  }
}

TEST(MapCloudLaws, MovesWithTheMap) {
  constexpr double kResolution_m = 0.5;
  const Pose T_other_map = Pose(Eigen::Translation3d(16.0, -8.0, 4.0));  // whole voxels
  const Cloud::Ptr map = mapCloud(scattered(), kResolution_m);
  const Cloud::Ptr other = mapCloud(scattered(T_other_map), kResolution_m);
  // rounding may put a point on the border of a voxel to its other side
  EXPECT_NEAR(static_cast<double>(other->size()), static_cast<double>(map->size()), 5.0);
}

TEST(MapCloudLaws, OfNothingIsNothing) {
  EXPECT_TRUE(mapCloud({}, 0.1)->empty());
  GraphSnapshot graph = scattered();
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    graph.keyframes.edit(k).cloud.reset(new Cloud);
  }
  EXPECT_TRUE(mapCloud(graph, 0.1)->empty());
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) graph.keyframes.edit(k).cloud.reset();
  EXPECT_TRUE(mapCloud(graph, 0.1)->empty()) << "of keyframes without clouds as well";
}

}  // namespace
}  // namespace mrpt_sgraphs
