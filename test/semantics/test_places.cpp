// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/places.h"

#include <gtest/gtest.h>

#include "mrpt_sgraphs/semantics/doors.h"
#include "support/small_building.h"

namespace mrpt_sgraphs {
namespace {

class PlacesTest : public ::testing::Test {
 protected:
  const test::SmallBuilding building_;
  const GraphSnapshotConstPtr graph_ = building_.snapshot();
};

TEST_F(PlacesTest, APlaceIsInTheRoomAroundItOnItsStorey) {
  const Place below = placeOf(*graph_, {1.0, 1.0, 0.3});
  ASSERT_NE(below.room, nullptr);
  EXPECT_EQ(below.room->id, RoomId{0});
  EXPECT_EQ(below.floor->id, FloorId{0});
  const Place above = placeOf(*graph_, {1.0, 1.0, 4.0});
  ASSERT_NE(above.room, nullptr);
  EXPECT_EQ(above.room->id, RoomId{2});
  EXPECT_EQ(above.floor->id, FloorId{1});
}

TEST_F(PlacesTest, BetweenTwoStoreysTheHeightTells) {
  EXPECT_EQ(placeOf(*graph_, {1.0, 1.0, 2.4}).room->id, RoomId{0});
  EXPECT_EQ(placeOf(*graph_, {1.0, 1.0, 2.6}).room->id, RoomId{2});  // a step below its ground
  EXPECT_EQ(placeOf(*graph_, {1.0, 1.0, 9.0}).room, nullptr);
  EXPECT_EQ(placeOf(*graph_, {1.0, 1.0, -2.0}).floor, nullptr);
}

TEST_F(PlacesTest, OutsideOfAllRoomsTheNearestOfTheStoreyIsKnown) {
  const Place place = placeOf(*graph_, {10.2, 1.0, 0.0});
  EXPECT_EQ(place.room, nullptr);
  EXPECT_EQ(place.floor->id, FloorId{0});
  ASSERT_NE(place.nearest, nullptr);
  EXPECT_EQ(place.nearest->id, RoomId{1});
  EXPECT_NEAR(place.distance_m, 1.0, 1e-12);
}

TEST_F(PlacesTest, WhatStandsInARoomIsNoPartOfIt) {
  test::SmallBuilding building;
  RoomAttributes room = building.graph.attributes(RoomId{0});
  room.extent_map.holes = {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}};
  building.graph.setAttributes(RoomId{0}, room);
  const GraphSnapshotConstPtr graph = building.snapshot();
  EXPECT_EQ(placeOf(*graph, {1.5, 1.5, 0.0}).room, nullptr);
  EXPECT_NEAR(areaOf(*findRoom(*graph, RoomId{0})), 11.0, 1e-9);
}

TEST_F(PlacesTest, TheBorderOfARoomIsTheNearestPlaceOnItsOutline) {
  const RoomNode& room = *findRoom(*graph_, RoomId{0});
  const auto border = nearestBorder(room, {3.5, 1.0, 7.0});
  ASSERT_TRUE(border);
  EXPECT_NEAR((border->nearest_map - Eigen::Vector3d(4.0, 1.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(border->along_map.y()), 1.0, 1e-12);
  EXPECT_NEAR(border->distance_m, 0.5, 1e-12);
  EXPECT_FALSE(nearestBorder(RoomNode{}, {0.0, 0.0, 0.0}));
}

TEST_F(PlacesTest, RoomsAreFoundByTheirNames) {
  ASSERT_EQ(roomsNamed(*graph_, "room 2").size(), 1U);
  EXPECT_EQ(roomsNamed(*graph_, "room 2")[0]->id, RoomId{2});
  EXPECT_TRUE(roomsNamed(*graph_, "Room 2").empty());
  EXPECT_EQ(findRoom(*graph_, RoomId{9}), nullptr);
}

TEST_F(PlacesTest, DoorsAndStairsAreThereOnceThoughBothSidesTellOfThem) {
  const std::vector<Door> doors = doorsOf(*graph_);
  ASSERT_EQ(doors.size(), 2U);
  EXPECT_EQ(doors[0].from, RoomId{0});
  EXPECT_EQ(doors[0].to, RoomId{1});
  EXPECT_NEAR((doors[0].end_map() - doors[0].begin_map()).norm(), 1.0, 1e-12);
  EXPECT_EQ(doors[1].to, std::nullopt);
  EXPECT_EQ(stairsOf(*graph_).size(), 1U);
}

TEST_F(PlacesTest, TwoDoorsBetweenTheSameRoomsAreTwo) {
  test::SmallBuilding building;
  RoomAttributes room = building.graph.attributes(RoomId{0});
  room.doorways.push_back({RoomId{1}, {4.0, 2.8, 0.0}, 0.5});
  building.graph.setAttributes(RoomId{0}, room);
  EXPECT_EQ(doorsOf(*building.snapshot()).size(), 3U);
}

}  // namespace
}  // namespace mrpt_sgraphs
