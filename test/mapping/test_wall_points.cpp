// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/mapping/node_colour.h"
#include "mrpt_sgraphs/mapping/wall_points.h"

namespace mrpt_sgraphs {
namespace {

constexpr WallPointsConfig kEveryPoint{0.05, 0.0};

void add(const Eigen::Vector3d& p_map, KeyframeNode* keyframe) {
  Cloud::Ptr cloud(keyframe->cloud ? new Cloud(*keyframe->cloud) : new Cloud);
  Point point;
  point.getVector3fMap() = (keyframe->T_map_base.inverse() * p_map).cast<float>();
  cloud->push_back(point);
  keyframe->cloud = cloud;
}

std::array<int, 3> rgbOf(WallId wall) {
  const Eigen::Vector3f rgb = 255.0F * colourOf(wall);
  return {static_cast<int>(std::lround(rgb[0])), static_cast<int>(std::lround(rgb[1])),
          static_cast<int>(std::lround(rgb[2]))};
}

/// Wall 3, x = 2 from y = 0 to 4, and wall 5, y = 4 from x = 0 to 2, both 2 m high and seen by the
/// one keyframe. Wall 3 has a door from y = 1 to 2.
class WallPoints : public ::testing::Test {
 protected:
  WallPoints() {
    WallNode wall;
    wall.id = WallId{3};
    wall.plane_map = {-Eigen::Vector3d::UnitX(), -2.0};
    wall.extent_map.outline = {{2, 0, 0}, {2, 0, 2}, {2, 4, 2}, {2, 4, 0}};
    wall.extent_map.holes = {{{2, 1, 0}, {2, 2, 0}, {2, 2, 1.8}, {2, 1, 1.8}}};
    graph_.walls.push_back(wall);
    wall = WallNode();
    wall.id = WallId{5};
    wall.plane_map = {-Eigen::Vector3d::UnitY(), -4.0};
    wall.extent_map.outline = {{0, 4, 0}, {2, 4, 0}, {2, 4, 2}, {0, 4, 2}};
    graph_.walls.push_back(wall);

    keyframe_.id = KeyframeId{7};
    keyframe_.T_map_base = Eigen::Translation3d(1.0, 1.0, 0.5) *
                           Pose(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
    see(WallId{3});
    see(WallId{5});
  }

  void see(WallId wall) {
    graph_.factors.push_back({FactorId{graph_.factors.size()},
                              std::make_shared<PlaneObservationFactor>(
                                  keyframe_.id, wall, Plane{}, Eigen::Matrix3d::Identity())});
  }

  ColouredCloud::Ptr points(const WallPointsConfig& config = kEveryPoint) {
    graph_.keyframes = {};
    graph_.keyframes.push_back(keyframe_);
    return wallPoints(graph_, config);
  }

  /// The colour of the only point that there is.
  std::array<int, 3> colour() {
    const auto cloud = points();
    EXPECT_EQ(cloud->size(), 1U);
    if (cloud->empty()) return {};
    return {cloud->front().r, cloud->front().g, cloud->front().b};
  }

  GraphSnapshot graph_;
  KeyframeNode keyframe_;
};

TEST_F(WallPoints, AreInTheMapInTheColourOfTheirWall) {
  add({2.0, 3.0, 1.0}, &keyframe_);
  EXPECT_EQ(colour(), rgbOf(WallId{3}));
  const auto cloud = points();
  EXPECT_NEAR((cloud->front().getVector3fMap() - Eigen::Vector3f(2, 3, 1)).norm(), 0.0F, 1e-5F);
}

TEST_F(WallPoints, AreNearThePlaneAndWithinTheExtent) {
  add({1.9, 3.0, 1.0}, &keyframe_);   // 10 cm before the wall
  add({2.1, 3.0, 1.0}, &keyframe_);   // and behind it
  add({2.0, 1.5, 1.0}, &keyframe_);   // in the door
  add({2.0, -0.5, 1.0}, &keyframe_);  // beside the wall
  add({2.0, 3.0, 2.5}, &keyframe_);   // above it
  EXPECT_TRUE(points()->empty());
  add({2.04, 1.5, 1.9}, &keyframe_);  // over the door
  EXPECT_EQ(colour(), rgbOf(WallId{3}));
}

TEST_F(WallPoints, AreOfTheNearestWallInACorner) {
  add({1.96, 3.99, 1.0}, &keyframe_);
  EXPECT_EQ(colour(), rgbOf(WallId{5}));
}

TEST_F(WallPoints, AreThoseOfKeyframesThatObserveTheWall) {
  add({2.0, 3.0, 1.0}, &keyframe_);
  keyframe_.id = KeyframeId{8};  // which has no factor
  EXPECT_TRUE(points()->empty());
}

TEST_F(WallPoints, AreThinnedOutWallByWall) {
  for (int k = 0; k < 50; ++k) add({2.02, 3.01 + 0.001 * k, 1.05}, &keyframe_);
  EXPECT_EQ(points()->size(), 50U);
  EXPECT_EQ(points({0.05, 0.1})->size(), 1U);
}

TEST_F(WallPoints, BearWallsAndKeyframesOfWhichLittleIsKnown) {
  graph_.walls.edit(0).extent_map = {};
  see(WallId{99});
  EXPECT_TRUE(points()->empty()) << "and no cloud";
  add({2.0, 3.0, 1.0}, &keyframe_);
  EXPECT_TRUE(points()->empty());
}

TEST(WallColour, DiffersFromWallToWallAndIsBright) {
  std::set<std::array<int, 3>> colours;
  for (std::uint64_t id = 0; id < 100; ++id) {
    const auto rgb = rgbOf(WallId{id});
    colours.insert(rgb);
    EXPECT_EQ(*std::max_element(rgb.begin(), rgb.end()), 230);
    EXPECT_LT(*std::min_element(rgb.begin(), rgb.end()), 60);
  }
  EXPECT_EQ(colours.size(), 100U);
}

}  // namespace
}  // namespace mrpt_sgraphs
