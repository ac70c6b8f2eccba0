// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>

#include "wall_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::Face;
using test::PlaneWorld;
using test::WallLab;

/// Walls of a stairwell, from the lower floor to the upper ceiling.
PlaneWorld stairwell() {
  PlaneWorld world;
  world.faces = {Face{{0.0, 0.0}, {8.0, 0.0}, {}, 0.0, 5.4},
                 Face{{8.0, 3.0}, {0.0, 3.0}, {}, 0.0, 5.4}};
  return world;
}

class WallStoreys : public ::testing::Test {
 protected:
  void walk(const std::optional<FloorId>& floor, double height_m, int steps = 5) {
    lab_.floor = floor;
    for (int k = 0; k < steps; ++k) {
      Pose T = Pose::Identity();
      T.translation() << 1.0 + k, 1.5, height_m + 0.6;
      lab_.step(T);
    }
  }

  void setFloor(KeyframeId id, FloorId floor) {
    KeyframeAttributes attributes = lab_.graph.attributes(id);
    attributes.floor = floor;
    lab_.graph.setAttributes(id, attributes);
  }

  /// Sightings of a wall by keyframes of a level that is not the wall's.
  int strangers() const {
    int count = 0;
    for (const auto& [number, track] : lab_.layer.tracks()) {
      for (const SurfaceSighting& sighting : track.sightings) {
        count += areApart(floorOf(sighting, lab_.graph), track.floor) ? 1 : 0;
      }
    }
    return count;
  }

  WallLab lab_{stairwell()};
};

TEST_F(WallStoreys, WhatTwoLevelsSeeIsTwoWalls) {
  walk(FloorId{0}, 0.0);
  walk(FloorId{1}, 2.7);
  walk(FloorId{0}, 0.0);
  EXPECT_EQ(lab_.wallsOnFaces(), (std::map<int, int>{{0, 2}, {1, 2}}));
  EXPECT_EQ(strangers(), 0);
  std::map<uint64_t, int> walls_of;
  for (const WallNode& wall : lab_.graph.snapshot()->walls) {
    ASSERT_TRUE(wall.floor);
    ++walls_of[wall.floor->value];
  }
  EXPECT_EQ(walls_of, (std::map<uint64_t, int>{{0, 2}, {1, 2}}));
}

TEST_F(WallStoreys, ThoseOnTheStairsSeeEither) {
  walk(FloorId{0}, 0.0);
  walk({}, 1.4);
  EXPECT_EQ(lab_.walls(), 2U);
  EXPECT_EQ(lab_.observations(), 20U);
}

/// The first keyframes of a storey do not know yet where they are.
TEST_F(WallStoreys, AWallIsTakenApartOnceItsLevelsAreKnown) {
  walk(FloorId{0}, 0.0);
  walk({}, 2.7);
  EXPECT_EQ(lab_.walls(), 2U);
  for (uint64_t k = 5; k < 10; ++k) setFloor(KeyframeId{k}, FloorId{1});
  EXPECT_TRUE(lab_.layer.maintain(lab_.way, &lab_.graph));
  EXPECT_EQ(lab_.wallsOnFaces(), (std::map<int, int>{{0, 2}, {1, 2}}));
  EXPECT_EQ(strangers(), 0);
  EXPECT_FALSE(lab_.layer.maintain(lab_.way, &lab_.graph)) << "and stays so";
}

TEST_F(WallStoreys, LevelsThatAreOneHaveOneWallAgain) {
  walk(FloorId{0}, 0.0);
  walk(FloorId{1}, 0.0);
  EXPECT_EQ(lab_.walls(), 4U);
  for (uint64_t k = 5; k < 10; ++k) setFloor(KeyframeId{k}, FloorId{0});
  EXPECT_TRUE(lab_.layer.maintain(lab_.way, &lab_.graph));
  EXPECT_EQ(lab_.wallsOnFaces(), (std::map<int, int>{{0, 1}, {1, 1}}));
}

TEST_F(WallStoreys, EachEndsAtTheGroundOfTheUpperOne) {
  walk(FloorId{0}, 0.0);
  walk(FloorId{1}, 2.7);
  lab_.graph.addFloor({Eigen::Vector3d::UnitZ(), 0.0}, {});
  lab_.graph.addFloor({Eigen::Vector3d::UnitZ(), 2.7}, {});
  lab_.layer.maintain(lab_.way, &lab_.graph);
  for (const WallNode& wall : lab_.graph.snapshot()->walls) {
    double bottom_m = 10.0;
    double top_m = -10.0;
    for (const Eigen::Vector3d& corner : wall.extent_map.outline) {
      bottom_m = std::min(bottom_m, corner.z());
      top_m = std::max(top_m, corner.z());
    }
    const bool is_upper = wall.floor == FloorId{1};
    EXPECT_NEAR(bottom_m, is_upper ? 2.7 : 0.0, 0.15);
    EXPECT_NEAR(top_m, is_upper ? 5.4 : 2.7, 0.15);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
