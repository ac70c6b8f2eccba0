// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/floor_grid.h"

#include <gtest/gtest.h>

#include "map_world.h"

namespace mrpt_sgraphs {
namespace {

using test::at;
using test::FlatWorld;
using test::keyframeAt;
using test::roomOf6by4;
using test::walkThrough;

FloorNode floorAt(uint64_t id, double height_m) {
  FloorNode floor;
  floor.id = FloorId{id};
  floor.ground_map = {Eigen::Vector3d::UnitZ(), height_m};
  return floor;
}

GraphSnapshot onFloor(GraphSnapshot graph, FloorId floor) {
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) graph.keyframes.edit(k).floor = floor;
  return graph;
}

std::vector<FloorGrid> gridsOf(const GraphSnapshot& graph) {
  OccupancyMap map{MapConfig{}};
  map.update(graph);
  return floorGrids(map, graph, MapConfig{});
}

std::int8_t valueAt(const FloorGrid& grid, double x_m, double y_m) {
  return grid.cells.valueOr(cellAt({x_m, y_m}, grid.cell_m), FloorGrid::kUnknown);
}

/// Walls occupied, what lies between them free.
void expectRoom(const FloorGrid& grid, double x_min, double x_max) {
  for (double x = x_min + 0.25; x < x_max - 0.2; x += 0.1) {
    for (double y = 0.25; y < 3.8; y += 0.1) {
      EXPECT_EQ(valueAt(grid, x, y), FloorGrid::kFree) << x << ' ' << y;
    }
  }
  for (double y = 0.45; y < 3.6; y += 0.1) {
    EXPECT_EQ(valueAt(grid, x_max + 0.05, y), FloorGrid::kOccupied) << y;
    EXPECT_EQ(valueAt(grid, x_max + 0.5, y), FloorGrid::kUnknown) << y;
  }
}

TEST(FloorGrid, WallsAndTablesAreOccupiedAndTheGroundIsNot) {
  FlatWorld world = roomOf6by4();
  world.rectangles.push_back({{3.05, 0.55, 0.45}, {0.8, 0, 0}, {0, 0.8, 0}});  // a table top
  world.rectangles.push_back({{4.55, 3.05, 0.05}, {0.5, 0, 0}, {0, 0.5, 0}});  // a sill
  GraphSnapshot graph = onFloor(walkThrough(world, 6), FloorId{4});
  graph.floors.push_back(floorAt(4, 0.0));
  const auto grids = gridsOf(graph);
  ASSERT_EQ(grids.size(), 1U);
  EXPECT_EQ(grids[0].floor, FloorId{4});
  EXPECT_EQ(grids[0].ground_m, 0.0);
  EXPECT_EQ(valueAt(grids[0], 3.4, 0.9), FloorGrid::kOccupied) << "the table";
  EXPECT_EQ(valueAt(grids[0], 4.8, 3.3), FloorGrid::kFree) << "the sill";
  EXPECT_EQ(valueAt(grids[0], 6.05, 2.0), FloorGrid::kOccupied) << "the wall";
  EXPECT_EQ(valueAt(grids[0], 2.0, 2.0), FloorGrid::kFree);
  EXPECT_EQ(valueAt(grids[0], 8.0, 2.0), FloorGrid::kUnknown);
}

TEST(FloorGrid, IsAroundWhatIsKnown) {
  GraphSnapshot graph = onFloor(walkThrough(roomOf6by4(), 3), FloorId{0});
  graph.floors.push_back(floorAt(0, 0.0));
  const CellBox box = gridsOf(graph)[0].cells.box();
  EXPECT_GE(box.min.column, -1);
  EXPECT_LE(box.max.column, 60);
  EXPECT_LE(box.max.row, 40);
}

/// The whole map leans, as after a start on a ramp: 3 degrees are 30 cm across the room.
TEST(FloorGrid, FollowsAGroundThatLeans) {
  Pose T_map_world = Pose::Identity();
  T_map_world.linear() = expSO3({0.0, 0.05, 0.0});
  GraphSnapshot graph = onFloor(walkThrough(roomOf6by4(), 6), FloorId{0});
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    KeyframeNode& keyframe = graph.keyframes.edit(k);
    keyframe.T_map_base = T_map_world * keyframe.T_map_base;
  }
  FloorNode floor = floorAt(0, 0.0);
  floor.ground_map = T_map_world * floor.ground_map;
  graph.floors.push_back(floor);
  const auto grids = gridsOf(graph);
  ASSERT_EQ(grids.size(), 1U);
  for (double x = 0.3; x < 5.7; x += 0.1) {
    for (double y = 0.3; y < 3.7; y += 0.1) {
      EXPECT_EQ(valueAt(grids[0], x, y), FloorGrid::kFree) << x << ' ' << y;
    }
  }
  EXPECT_NEAR(grids[0].ground_m, -0.15, 0.02) << "in the middle";
}

TEST(FloorGrid, StoreysAboveEachOtherHaveTheirOwn) {
  const FlatWorld below = roomOf6by4();
  const FlatWorld above = FlatWorld::box({0, 0, 3}, {4, 4, 5.6});
  GraphSnapshot graph = onFloor(walkThrough(below, 4), FloorId{0});
  for (uint64_t id = 10; id < 13; ++id) {
    KeyframeNode keyframe = keyframeAt(id, above, at(0.1 * static_cast<double>(id), 2.0, 3.7));
    keyframe.floor = FloorId{1};
    graph.keyframes.push_back(keyframe);
  }
  graph.floors.push_back(floorAt(0, 0.0));
  graph.floors.push_back(floorAt(1, 3.0));
  const auto grids = gridsOf(graph);
  ASSERT_EQ(grids.size(), 2U);
  expectRoom(grids[0], 0.0, 6.0);
  expectRoom(grids[1], 0.0, 4.0);
  EXPECT_EQ(grids[1].ground_m, 3.0);
}

/// Half a storey up beside it: the ground there is at the height of a table here.
TEST(FloorGrid, FloorsBesideEachOtherAreNoObstaclesToEachOther) {
  const FlatWorld here = roomOf6by4();
  const FlatWorld there = FlatWorld::box({6.2, 0, 1.2}, {12, 4, 3.8});
  GraphSnapshot graph = onFloor(walkThrough(here, 4), FloorId{0});
  for (uint64_t id = 10; id < 13; ++id) {
    KeyframeNode keyframe =
        keyframeAt(id, there, at(0.5 * static_cast<double>(id) + 3.0, 2.0, 1.9));
    keyframe.floor = FloorId{1};
    graph.keyframes.push_back(keyframe);
  }
  graph.floors.push_back(floorAt(0, 0.0));
  graph.floors.push_back(floorAt(1, 1.2));
  const auto grids = gridsOf(graph);
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_EQ(valueAt(grids[0], 9.0, 2.0), FloorGrid::kUnknown);
  EXPECT_EQ(valueAt(grids[1], 9.0, 2.0), FloorGrid::kFree);
  EXPECT_EQ(valueAt(grids[0], 3.0, 2.0), FloorGrid::kFree);
  EXPECT_EQ(valueAt(grids[1], 3.0, 2.0), FloorGrid::kUnknown);
}

TEST(FloorGrid, AFloorOfWhichNothingIsKnownHasNone) {
  GraphSnapshot graph = onFloor(walkThrough(roomOf6by4(), 2), FloorId{0});
  graph.floors.push_back(floorAt(0, 0.0));
  graph.floors.push_back(floorAt(1, 50.0));
  EXPECT_EQ(gridsOf(graph).size(), 1U);
  graph.floors.pop_back();
  graph.floors.pop_back();
  EXPECT_TRUE(gridsOf(graph).empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
