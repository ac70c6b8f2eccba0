// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "sim/floor_plan.h"
#include "sim/wall_faces.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

/// A slip in a file and what the message has to say about it.
struct Slip {
  const char* name;
  std::string from;
  std::string to;
  std::vector<std::string> message;

  friend void PrintTo(const Slip& slip, std::ostream* stream) { *stream << slip.name; }
};

class BrokenBuilding : public ::testing::TestWithParam<Slip> {};

TEST_P(BrokenBuilding, IsRefusedByNameAndLine) {
  const Slip& slip = GetParam();
  try {
    walkTour(test::buildingFrom(test::replaced(test::kTwoRooms, slip.from, slip.to)),
             robotNamed("legged"));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& part : slip.message) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "'" << part << "' is not in: " << error.what();
    }
  }
}

const std::string kDoor = "{at: [5.1, 2.0], width_m: 1.0, height_m: 2.0}";
const std::string kRight = "{name: right, rectangle: [5.2, 0.0, 9.0, 4.0]}";
const std::string kLastStop = "{room: right, at: [[7.5, 2.5]]}";

INSTANTIATE_TEST_SUITE_P(
    Slips, BrokenBuilding,
    ::testing::Values(
        Slip{"NotYaml", "name: two_rooms", "name: [two", {".yaml:2", "not YAML"}},
        Slip{"UnknownField", "height_m: 3.0", "hight_m: 3.0", {".yaml:3", "'hight_m'"}},
        Slip{"MissingField", "    height_m: 3.0\n", "", {".yaml:3", "storey", "'height_m'"}},
        Slip{"NotANumber", "height_m: 3.0", "height_m: high", {":3:", "'height_m'", "number"}},
        Slip{"Negative", "height_m: 3.0", "height_m: -3.0", {":3:", "'height_m'", "positive"}},
        Slip{"Overlap", kRight, "{name: right, rectangle: [4.8, 0, 9, 4]}", {":8:", "overlaps"}},
        Slip{"NoWall", kRight, "{name: right, rectangle: [5.0, 0, 9, 4]}", {":8:", "'left'"}},
        Slip{"Clockwise",
             kRight,
             "{name: right, polygon: [[6, 0], [6, 4], [9, 4]]}",
             {":8:", "counter-clockwise"}},
        Slip{"Crossing",
             kRight,
             "{name: right, polygon: [[6, 0], [9, 4], [9, 0], [6, 4]]}",
             {":8:", "crosses itself"}},
        Slip{"TwiceNamed",
             kRight,
             kRight + "\n      - {name: left, rectangle: [20, 0, 25, 4]}",
             {":9:", "'left'", "twice"}},
        Slip{"BadKind",
             kRight,
             "{name: right, kind: attic, rectangle: [5.2, 0, 9, 4]}",
             {":8:", "'kind'", "attic"}},
        Slip{"DoorToNowhere", kDoor, "{at: [2.0, 0.0]}", {":10:", "door", "instead of two"}},
        Slip{"DoorAtCorner", kDoor, "{at: [5.1, 0.2]}", {":10:", "'width_m'", "fit"}},
        Slip{"HighDoor", kDoor, "{at: [5.1, 2.0], height_m: 3.0}", {":10:", "'height_m'"}},
        Slip{"WindowInNoWall", "at: [0.0, 3.0]", "at: [2.5, 2.0]", {":12:", "window"}},
        Slip{"WindowInDoor", "at: [0.0, 3.0]", "at: [5.0, 2.2]", {":12:", "overlaps", ":10:"}},
        Slip{"ShelfInWall",
             "tour:",
             "    furniture: [{at: [0.2, 2], size_m: [1, 1, 1]}]\ntour:",
             {":13:", "furniture", "'left'"}},
        Slip{"PersonThroughWall",
             "tour:",
             "    people: [{from: [1, 1], to: [8, 1]}]\ntour:",
             {":13:", "person", "one room"}},
        Slip{"UnknownRoom", kLastStop, "attic", {":15:", "'attic'"}},
        Slip{"StopOutside", kLastStop, "{room: right, at: [[1, 1]]}", {":15:", "'right'"}},
        Slip{"NoWay", "    doors:\n      - " + kDoor + "\n", "", {":13:", "'right'", "doors"}},
        Slip{"BlockedDoor",
             "tour:",
             "    furniture: [{at: [6.0, 2], size_m: [1, 2, 1]}]\ntour:",
             {":10:", "door", "'right'"}},
        Slip{"BlockedRoom",
             "tour:",
             "    furniture: [{at: [2.6, 2], size_m: [0.5, 4, 1]}]\ntour:",
             {":16:", "'left'", "blocks"}}),
    [](const auto& info) { return info.param.name; });

TEST(Building, MissingFileIsNamed) {
  try {
    loadBuilding("/nowhere/office.yaml");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/office.yaml"), std::string::npos);
  }
}

TEST(Building, IsTurnedAsAWhole) {
  const Building straight = test::buildingFrom(test::kTwoRooms);
  const Building turned = test::buildingFrom("rotation_deg: 90\n" + test::kTwoRooms);
  const auto expected = [](const Eigen::Vector2d& p) { return leftOf(p); };
  for (size_t r = 0; r < straight.rooms.size(); ++r) {
    for (size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR((turned.rooms[r].outline[k] - expected(straight.rooms[r].outline[k])).norm(), 0.0,
                  1e-12);
    }
  }
  EXPECT_NEAR((turned.doors[0].at - expected(straight.doors[0].at)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((turned.tour[0].points[0] - expected(straight.tour[0].points[0])).norm(), 0.0, 1e-12);
}

TEST(WallFaces, LookIntoTheirRoomsAndCarryTheirOpenings) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const std::vector<WallFace> faces = wallFaces(building);
  ASSERT_EQ(faces.size(), 8U);
  size_t openings = 0;
  for (const WallFace& face : faces) {
    const Eigen::Vector2d middle = 0.5 * (face.first + face.second);
    constexpr double kStep_m = 0.01;
    EXPECT_TRUE(contains(building.rooms[face.room].outline, middle + kStep_m * face.inward()));
    openings += face.openings.size();
  }
  EXPECT_EQ(openings, 3U);  // a door has two faces, a window one
}

TEST(FloorPlan, ClearanceIsDistanceToTheNearestObstacle) {
  const FloorPlan plan(
      test::buildingFrom(test::replaced(test::kTwoRooms, "tour:",
                                        "    furniture: [{at: [2.0, 3.0], size_m: [1, 0.5, 1]}]\n"
                                        "    pillars: [{at: [3.5, 1.0], radius_m: 0.2}]\ntour:")),
      0);
  EXPECT_NEAR(plan.clearance({0.6, 1.5}), 0.6, 1e-12);   // wall
  EXPECT_NEAR(plan.clearance({5.1, 2.0}), 0.5, 1e-12);   // between the jambs
  EXPECT_NEAR(plan.clearance({2.0, 2.5}), 0.25, 1e-12);  // furniture
  EXPECT_NEAR(plan.clearance({3.5, 1.5}), 0.3, 1e-12);   // pillar
  EXPECT_LT(plan.clearance({2.0, 3.0}), 0.0);            // inside furniture
  EXPECT_LT(plan.clearance({5.1, 1.0}), 0.0);            // inside the wall
  EXPECT_LT(plan.clearance({-1.0, 1.0}), 0.0);           // outside
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
