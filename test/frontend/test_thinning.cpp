// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/thinning.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

namespace mrpt_sgraphs {
namespace {

constexpr double kEdge_m = 0.25;  // its inverse is exact

using Voxel = std::array<int, 3>;

Voxel voxelOf(const Eigen::Vector3f& p) {
  const Eigen::Array3f index = (p.array() / static_cast<float>(kEdge_m)).floor();
  return {static_cast<int>(index.x()), static_cast<int>(index.y()), static_cast<int>(index.z())};
}

/// Points all about the origin.
Cloud randomCloud(std::size_t size, float extent_m) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> coordinate(-extent_m, extent_m);
  Cloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    Point point;
    point.x = coordinate(generator);
    point.y = coordinate(generator);
    point.z = coordinate(generator);
    point.intensity = static_cast<float>(i);
    cloud.push_back(point);
  }
  return cloud;
}

TEST(VoxelSet, TellsNewVoxelsFromKnownOnes) {
  VoxelSet voxels(kEdge_m);
  std::set<Voxel> seen;
  for (const Point& point : randomCloud(20000, 3.0F)) {
    const Eigen::Vector3f p = point.getVector3fMap();
    ASSERT_EQ(voxels.insert(p), seen.insert(voxelOf(p)).second) << p.transpose();
  }
  EXPECT_GT(seen.size(), 5000U);  // it has grown beyond what it began with
}

TEST(VoxelSet, KeepsEverythingWhenItGrows) {
  for (const std::size_t expected : {0U, 10U, 200000U}) {
    VoxelSet voxels(1.0, expected);
    constexpr int kSide = 50;
    for (const bool is_new : {true, false}) {
      for (int x = -kSide; x < kSide; ++x) {
        for (int y = -kSide; y < kSide; ++y) {
          ASSERT_EQ(voxels.insert({x + 0.5F, y + 0.5F, -7.5F}), is_new) << x << " " << y;
        }
      }
    }
  }
}

TEST(VoxelSet, CutsSpaceAtTheOriginToo) {
  for (int axis = 0; axis < 3; ++axis) {
    VoxelSet voxels(kEdge_m);
    Eigen::Vector3f p(0.1F, 0.1F, 0.1F);
    EXPECT_TRUE(voxels.insert(p));
    p[axis] = -0.1F;
    EXPECT_TRUE(voxels.insert(p));
    p[axis] = -0.2F;
    EXPECT_FALSE(voxels.insert(p));
    p[axis] = -0.26F;
    EXPECT_TRUE(voxels.insert(p));
  }
}

TEST(VoxelSet, ReachesAMillionVoxelsFar) {
  VoxelSet voxels(1.0);
  for (const float far : {-1e6F, -1.0F, 0.0F, 1.0F, 1e6F}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (far == 0.0F && axis > 0) continue;
      EXPECT_TRUE(voxels.insert(far * Eigen::Vector3f::Unit(axis))) << far << " " << axis;
    }
  }
}

TEST(Thinning, KeepsTheFirstPointOfEveryVoxelInOrder) {
  const Cloud cloud = randomCloud(30000, 3.0F);
  std::vector<int> expected;
  std::set<Voxel> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (seen.insert(voxelOf(cloud[i].getVector3fMap())).second) {
      expected.push_back(static_cast<int>(i));
    }
  }
  EXPECT_EQ(firstInVoxels(cloud, kEdge_m), expected);
}

TEST(Thinning, ChangesNoPointAndKeepsWhatTheCloudSaysOfItself) {
  Cloud cloud = randomCloud(30000, 3.0F);
  cloud.header.stamp = 123456;
  cloud.header.frame_id = "base_link";
  cloud.sensor_origin_ << 0.1F, 0.2F, 0.3F, 0.0F;
  const Cloud::Ptr thin = thinned(cloud, kEdge_m);
  EXPECT_LT(thin->size(), cloud.size());
  EXPECT_EQ(thin->header.stamp, cloud.header.stamp);
  EXPECT_EQ(thin->header.frame_id, cloud.header.frame_id);
  EXPECT_EQ(thin->sensor_origin_, cloud.sensor_origin_);
  for (const Point& point : *thin) {
    const Point& original = cloud[static_cast<std::size_t>(point.intensity)];
    ASSERT_EQ(point.getVector3fMap(), original.getVector3fMap());
  }
  EXPECT_EQ(thinned(*thin, kEdge_m)->size(), thin->size()) << "thin is thin";
}

TEST(Thinning, OfNothingIsNothing) {
  EXPECT_TRUE(firstInVoxels({}, kEdge_m).empty());
  EXPECT_TRUE(thinned({}, kEdge_m)->empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
