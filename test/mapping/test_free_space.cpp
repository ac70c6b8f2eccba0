// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "mrpt_sgraphs/mapping/free_space.h"
#include "support/flat_world.h"

namespace mrpt_sgraphs {
namespace {

using test::FlatWorld;
using test::Pattern;
using Space = FreeSpace::Space;

Pose at(double x, double y, double z, double yaw_rad = 0.0) {
  return expPose((Tangent() << x, y, z, 0.0, 0.0, yaw_rad).finished());
}

Cloud seenFrom(const FlatWorld& world, const Pose& T_world_sensor) {
  std::mt19937 random(1);
  return scanOf(world, Pattern::spinning(32, 900, -0.4, 0.4), T_world_sensor, 0.0, &random);
}

FlatWorld roomOf6by4() { return FlatWorld::box({0, 0, 0}, {6, 4, 2.6}); }

TEST(FreeSpace, RoomIsFreeAndItsWallsAreOccupied) {
  FreeSpace space{FreeSpaceConfig{}};
  const Pose T = at(2.0, 2.0, 1.0);
  space.add(seenFrom(roomOf6by4(), T), T);
  EXPECT_EQ(space.at({30, 20}), Space::kFree);
  EXPECT_EQ(space.at({60, 20}), Space::kOccupied) << "the wall at x = 6";
  EXPECT_EQ(space.at({75, 20}), Space::kUnknown) << "behind it";
  EXPECT_EQ(space.at({1000, 20}), Space::kUnknown) << "outside of all that was seen";
}

TEST(FreeSpace, TableIsNoObstacleAndACupboardIs) {
  FlatWorld world = roomOf6by4();
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 2.0);
  world.rectangles.push_back({{3.05, 1.05, 0.75}, 0.9 * x, 0.9 * y});  // a table top
  world.rectangles.push_back({{4.05, 2.55, 0.0}, y, z});               // a cupboard's front
  FreeSpace space{FreeSpaceConfig{}};
  for (const double px : {1.0, 2.0, 3.0}) {
    for (const double height : {0.6, 1.2}) {
      const Pose T = at(px, 3.0, height);
      space.add(seenFrom(world, T), T);
    }
  }
  EXPECT_EQ(space.at({35, 15}), Space::kFree);
  EXPECT_EQ(space.at({40, 30}), Space::kOccupied);
}

TEST(FreeSpace, RemovingUndoesAdding) {
  const FlatWorld world = roomOf6by4();
  const Pose here = at(2.0, 2.0, 1.0);
  const Pose there = at(4.0, 1.0, 1.1, 0.7);
  const Cloud from_here = seenFrom(world, here);
  const Cloud from_there = seenFrom(world, there);
  FreeSpace once{FreeSpaceConfig{}};
  once.add(from_here, here);
  FreeSpace space{FreeSpaceConfig{}};
  space.add(from_there, at(4.3, 1.2, 1.1, 0.8));  // where it was believed to be
  space.add(from_here, here);
  space.remove(from_there, at(4.3, 1.2, 1.1, 0.8));
  for (int row = -20; row < 70; ++row) {
    for (int column = -20; column < 90; ++column) {
      EXPECT_EQ(space.at({column, row}), once.at({column, row})) << column << ' ' << row;
    }
  }
  space.remove(from_here, here);
  EXPECT_EQ(space.at({30, 20}), Space::kUnknown);
}

TEST(FreeSpace, NothingOutsideOfTheSlabCounts) {
  FreeSpaceConfig config;
  config.min_height_m = 1.5;
  config.max_height_m = 1.9;
  FreeSpace space{config};
  FlatWorld world = roomOf6by4();
  const Eigen::Vector3d y(0, 1, 0), z(0, 0, 1.2);
  world.rectangles.push_back({{4.05, 0.5, 0.0}, 3 * y, z});  // lower than the slab
  const Pose T = at(2.0, 2.0, 1.0);
  space.add(seenFrom(world, T), T);
  EXPECT_NE(space.at({40, 20}), Space::kOccupied);
  EXPECT_EQ(space.at({60, 20}), Space::kOccupied);
}

TEST(FreeSpace, OftenSeenFreeOutweighsSomeoneWhoStoodThere) {
  FreeSpace space{FreeSpaceConfig{}};
  const Pose T = at(2.0, 2.0, 1.0);
  FlatWorld crowded = roomOf6by4();
  crowded.pillars.push_back({{4.05, 2.05}, 0.2});
  space.add(seenFrom(crowded, T), T);
  EXPECT_EQ(space.at({38, 20}), Space::kOccupied);
  const Cloud empty = seenFrom(roomOf6by4(), T);
  for (int k = 0; k < 4; ++k) space.add(empty, T);
  EXPECT_EQ(space.at({38, 20}), Space::kFree);
}

}  // namespace
}  // namespace mrpt_sgraphs
