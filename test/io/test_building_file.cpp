// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "graph_files.h"
#include "mrpt_sgraphs/io/building_file.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

constexpr const char* kBuilding = R"({"walls": [], "floors": [{"id": 1, "elevation": 3.3}],
  "rooms": [
    {"id": 5, "name": "hall", "kind": "corridor", "floor": 1, "entered": false, "height": 2.7,
     "polygon": [[0,0,3.3],[4,0,3.3],[4,4,3.3],[0,4,3.3]]},
    {"polygon": [[5,0,0],[9,0,0],[9,4,0]]}]})";

constexpr const char* kBoxes = R"([
  {"name": "21", "min": [15.3, -14.7, 3.55], "max": [18.3, -8.8, 6.8], "scans_inside": 29},
  {"name": "22", "min": [19.0, -14.7, 3.60], "max": [20.0, -8.8, 6.8], "scans_inside": 9},
  {"name": "31", "min": [15.3, -14.7, 7.00], "max": [18.3, -8.8, 9.8], "scans_inside": 9}])";

TEST(BuildingFile, ObstaclesHaveSidesAndATop) {
  const test::TemporaryFolder folder;
  const std::string text = R"({"walls": [], "rooms": [{"polygon": [[0,0,0],[9,0,0],[9,4,0]]}],
    "obstacles": [{"polygon": [[1,1,0.5],[2,1,0.5],[2,3,0.5],[1,3,0.5]], "height": 0.25}]})";
  const TrueBuilding building = readBuilding(folder.write("building.json", text));
  ASSERT_EQ(building.surfaces.size(), 6u);
  const Eigen::Vector3d on_top(1.5, 2.0, 0.75), on_a_side(2.0, 2.0, 0.6), below(1.5, 2.0, 0.5);
  const auto nearest_m = [&](const Eigen::Vector3d& point) {
    double least = 1e9;
    for (std::size_t k = 1; k < 6; ++k) {
      least = std::min(least, building.surfaces[k].distance(point));
    }
    return least;
  };
  EXPECT_NEAR(nearest_m(on_top), 0.0, 1e-12);
  EXPECT_NEAR(nearest_m(on_a_side), 0.0, 1e-12);
  EXPECT_NEAR(nearest_m(below), 0.25, 1e-12);
  const std::string flat = R"({"walls": [], "rooms": [{"polygon": [[0,0,0],[9,0,0],[9,4,0]]}],
    "obstacles": [{"polygon": [[1,1,0],[2,1,0],[2,3,0]], "height": 0.0}]})";
  EXPECT_THROW(readBuilding(folder.write("flat.json", flat)), std::runtime_error);
}

TEST(BuildingFile, TellsOfRoomsAndFloors) {
  const test::TemporaryFolder folder;
  const TrueBuilding building = readBuilding(folder.write("building.json", kBuilding));
  ASSERT_EQ(building.rooms.size(), 2u);
  EXPECT_EQ(building.rooms[0].id, 5u);
  EXPECT_EQ(building.rooms[0].name, "hall");
  EXPECT_EQ(building.rooms[0].kind, TrueRoom::Kind::kCorridor);
  EXPECT_EQ(building.rooms[0].height_m, 2.7);
  EXPECT_FALSE(building.rooms[0].entered);
  EXPECT_EQ(building.rooms[0].extent.outline[2], Eigen::Vector3d(4.0, 4.0, 3.3));
  EXPECT_EQ(building.rooms[1].id, 1u);  // its place
  EXPECT_EQ(building.rooms[1].kind, TrueRoom::Kind::kRoom);
  EXPECT_TRUE(building.rooms[1].entered);
  EXPECT_TRUE(building.all_rooms_listed);
  EXPECT_EQ(building.surfaces.size(), 3u);  // one ceiling
  ASSERT_EQ(building.floors.size(), 1u);
  EXPECT_EQ(building.floors[0].id, 1u);
  EXPECT_EQ(building.floors[0].elevation_m, 3.3);
}

TEST(BuildingFile, RoomsMayBeAListOfBoxes) {
  const test::TemporaryFolder folder;
  TrueBuilding building = readBuilding(folder.write("building.json", kBuilding));
  readRoomBoxes(folder.write("rooms.json", kBoxes), &building);
  ASSERT_EQ(building.rooms.size(), 3u);
  EXPECT_EQ(building.rooms[1].name, "22");
  EXPECT_TRUE(building.rooms[1].entered);
  ASSERT_EQ(building.rooms[0].extent.outline.size(), 4u);
  EXPECT_EQ(building.rooms[0].extent.outline[2], Eigen::Vector3d(18.3, -8.8, 3.55));
  EXPECT_NEAR(*building.rooms[0].height_m, 3.25, 1e-9);
  EXPECT_FALSE(building.all_rooms_listed);
  ASSERT_EQ(building.floors.size(), 2u);
  EXPECT_EQ(building.floors[0].elevation_m, 3.55);
  EXPECT_EQ(building.floors[1].elevation_m, 7.0);
  EXPECT_EQ(building.surfaces.size(), 3u);  // those of the building
}

TEST(BuildingFile, NamesWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto building = [&](const std::string& text) {
    const std::string path = folder.write("building.json", text);
    return test::messageOf<std::runtime_error>([&] { readBuilding(path); });
  };
  EXPECT_SAYS(building(test::with(kBuilding, "corridor", "hall")), "rooms/0/kind is none of room");
  EXPECT_SAYS(building(test::with(kBuilding, "false", "0")), "rooms/0/entered is neither true");
  EXPECT_SAYS(building(test::with(kBuilding, ",[9,4,0]", "")), "rooms/1/polygon has fewer than 3");
  EXPECT_SAYS(building(test::with(kBuilding, "\"elevation\": 3.3", "")), "building.json");

  const auto boxes = [&](const std::string& text) {
    const std::string path = folder.write("rooms.json", text);
    TrueBuilding ignored;
    return test::messageOf<std::runtime_error>([&] { readRoomBoxes(path, &ignored); });
  };
  EXPECT_SAYS(boxes(test::with(kBoxes, "18.3", "11.3")), "rooms: 0/max is not above min");
  EXPECT_SAYS(boxes("{}"), "rooms.json");
  EXPECT_SAYS(boxes(""), "rooms.json");
}

}  // namespace
}  // namespace mrpt_sgraphs
