// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/semantics/room_detector.h"
#include "plan_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::Face;
using test::PlanLab;
using Kind = RoomAttributes::Kind;

constexpr double kThickness_m = 0.16;

RoomDetection detect(const PlanLab& lab) {
  return RoomDetector(RoomDetectorConfig{}).detect(*lab.graph.snapshot());
}

/// The room that a place of the plan lies in.
const DetectedRoom* roomAt(const RoomDetection& detection, const PlanLab& lab,
                           const Eigen::Vector2d& place) {
  for (const DetectedRoom& room : detection.rooms) {
    if (contains(FlatExtent{lab.outlineOf(room), {}}, place)) return &room;
  }
  return nullptr;
}

/// Two rooms of 5 x 4 m side by side, with a door of 0.9 m between them.
void addTwoRooms(PlanLab* lab) {
  lab->addBox(10, 4);
  lab->addWall({5, 0}, {5, 4}, {{1.5, 2.4}});
}

TEST(RoomDetector, FindsRoomsAndTheDoorBetweenThem) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {9, 2});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 2U);
  for (const DetectedRoom& room : detection.rooms) {
    EXPECT_EQ(room.kind, Kind::kFourWalls);
    EXPECT_EQ(room.walls.size(), 4U);
    EXPECT_NEAR(signedArea(lab.outlineOf(room)), (5.0 - kThickness_m) * (4.0 - kThickness_m), 0.1);
    EXPECT_NEAR(room.size_m.x(), 5.0 - kThickness_m, 0.03);
    EXPECT_NEAR(room.size_m.y(), 4.0 - kThickness_m, 0.03);
    EXPECT_NEAR(room.height_m, 2.7, 0.01);
    EXPECT_EQ(room.floor, FloorId{0});
    ASSERT_EQ(room.doorways.size(), 1U);
    ASSERT_TRUE(room.doorways[0].to);
    EXPECT_EQ(&detection.rooms[1 - *room.doorways[0].to], &room);
    EXPECT_NEAR(room.doorways[0].width_m, 0.9, 0.15);
    const Eigen::Vector3d door = lab.graph.pose(room.anchor) * room.doorways[0].centre_anchor;
    EXPECT_NEAR((door - Eigen::Vector3d(5.0, 1.95, 0.0)).norm(), 0.0, 0.12);
  }
  EXPECT_EQ(detection.rooms[0].keyframes.size() + detection.rooms[1].keyframes.size(), 8U)
      << "the one in the door is in neither";
}

/// What every second keyframe has seen the others have seen, too.
TEST(RoomDetector, RoomsStayWhatTheyAreWhenCloudsAreLetGo) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {9, 2});
  RoomDetector detector{RoomDetectorConfig{}};
  const RoomDetection before = detector.detect(*lab.graph.snapshot());
  std::vector<std::weak_ptr<const Cloud>> clouds;
  for (std::size_t k = 1; k < lab.graph.size(Layer::kKeyframe); k += 2) {
    KeyframeAttributes attributes = lab.graph.attributes(KeyframeId{k});
    clouds.emplace_back(attributes.cloud);
    attributes.cloud.reset();
    lab.graph.setAttributes(KeyframeId{k}, attributes);
  }
  const RoomDetection after = detector.detect(*lab.graph.snapshot());
  for (const auto& cloud : clouds) EXPECT_TRUE(cloud.expired()) << "the detector keeps it";
  ASSERT_EQ(after.rooms.size(), before.rooms.size());
  for (std::size_t k = 0; k < before.rooms.size(); ++k) {
    EXPECT_EQ(after.rooms[k].walls.size(), before.rooms[k].walls.size());
    EXPECT_EQ(after.rooms[k].keyframes, before.rooms[k].keyframes);
    EXPECT_EQ(after.rooms[k].doorways.size(), before.rooms[k].doorways.size());
    EXPECT_NEAR(signedArea(lab.outlineOf(after.rooms[k])),
                signedArea(lab.outlineOf(before.rooms[k])), 0.1);
  }
}

TEST(RoomDetector, AxesPointAlongTheWallsNormals) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {9, 2});
  const LayeredGraph& graph = lab.graph;
  for (const DetectedRoom& room : detect(lab).rooms) {
    const Pose T_map_room = graph.pose(room.anchor) * room.T_anchor_room;
    EXPECT_NEAR(T_map_room.translation().z(), 0.0, 1e-9);
    for (const BoundingWall& wall : room.walls) {
      const Eigen::Vector3d axis_map = T_map_room.linear() * wall.axis_room;
      EXPECT_NEAR((axis_map - graph.plane(wall.id).normal).norm(), 0.0, 0.01);
      EXPECT_GT(graph.plane(wall.id).normal.dot(T_map_room.translation()),
                graph.plane(wall.id).distance)
          << "walls look into the room";
    }
  }
}

/// Turned, shifted and a little tilted, as a map is that began without an IMU.
TEST(RoomDetector, FindsTheSameWhateverTheMapsFrame) {
  PlanLab straight;
  straight.addFloor(0.0);
  addTwoRooms(&straight);
  straight.walk({1, 2}, {9, 2});
  const RoomDetection expected = detect(straight);
  for (const double yaw_rad : {0.3, 0.25 * M_PI, 1.2, 3.0}) {
    PlanLab lab;
    lab.T_map_world = expPose((Tangent() << 31.0, -17.0, 4.0, 0.02, -0.025, yaw_rad).finished());
    lab.addFloor(0.0);
    addTwoRooms(&lab);
    lab.walk({1, 2}, {9, 2});
    const RoomDetection found = detect(lab);
    ASSERT_EQ(found.rooms.size(), expected.rooms.size()) << yaw_rad;
    for (const DetectedRoom& room : expected.rooms) {
      const Eigen::Vector2d inside =
          (straight.graph.pose(room.anchor) * room.T_anchor_room).translation().head<2>();
      const DetectedRoom* const same = roomAt(found, lab, inside);
      ASSERT_NE(same, nullptr) << yaw_rad;
      EXPECT_EQ(same->walls.size(), room.walls.size());
      EXPECT_EQ(same->keyframes, room.keyframes);
      EXPECT_NEAR(signedArea(lab.outlineOf(*same)), signedArea(straight.outlineOf(room)), 0.1);
    }
  }
}

TEST(RoomDetector, LShapeIsOneRoomWithSixCorners) {
  PlanLab lab;
  lab.addFloor(0.0);
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 9}, {0, 9}};
  lab.addFaces(corners);
  lab.walk({6, 2}, {2, 2});
  lab.walk({2, 3}, {2, 7});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  const DetectedRoom& room = detection.rooms[0];
  EXPECT_EQ(room.kind, Kind::kPolygon);
  EXPECT_EQ(room.extent_anchor.outline.size(), 6U);
  EXPECT_EQ(room.walls.size(), 6U);
  EXPECT_NEAR(signedArea(lab.outlineOf(room)), 52.0, 0.3);
}

TEST(RoomDetector, CorridorWithABendIsOneCorridor) {
  PlanLab lab;
  lab.addFloor(0.0);
  const std::vector<Eigen::Vector2d> corners{{0, 0},      {12, 0},   {18, 6},
                                             {16.6, 7.4}, {11.2, 2}, {0, 2}};
  lab.addFaces(corners);
  lab.walk({1, 1}, {11.5, 1});
  lab.walk({12, 1.4}, {16.5, 6});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  EXPECT_EQ(detection.rooms[0].kind, Kind::kCorridor);
  EXPECT_NEAR(signedArea(lab.outlineOf(detection.rooms[0])),
              signedArea(Outline2(corners.begin(), corners.end())), 0.5);
}

/// Four blocks with corridors between them: no door, so the cross is one corridor.
TEST(RoomDetector, CrossingCorridorsAreOneRegion) {
  PlanLab lab;
  lab.addFloor(0.0);
  const auto block = [&lab](double x, double y) {
    lab.addFaces({{x, y}, {x, y + 6}, {x + 6, y + 6}, {x + 6, y}});
  };
  for (const double x : {0.0, 8.0}) {
    for (const double y : {0.0, 8.0}) block(x, y);
  }
  lab.addFace({{0, 8}, {0, 6}, {}});  // the ends of the corridors
  lab.addFace({{14, 6}, {14, 8}, {}});
  lab.addFace({{6, 0}, {8, 0}, {}});
  lab.addFace({{8, 14}, {6, 14}, {}});
  lab.walk({1, 7}, {13, 7});
  lab.walk({7, 13}, {7, 1});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  EXPECT_EQ(detection.rooms[0].kind, Kind::kCorridor);
  EXPECT_EQ(detection.rooms[0].extent_anchor.outline.size(), 12U);
  EXPECT_NEAR(signedArea(lab.outlineOf(detection.rooms[0])), 2 * 14 * 2 - 4, 0.5);
  EXPECT_TRUE(detection.rooms[0].doorways.empty());
}

TEST(RoomDetector, OpenPlanWithAPartitionIsOneRegion) {
  PlanLab lab;
  lab.addFloor(0.0);
  lab.addBox(14, 9);
  lab.addWall({7, 0}, {7, 3});  // reaches a third into it
  lab.walk({3, 6}, {11, 6});
  lab.walk({11, 5}, {11, 2});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  EXPECT_GT(signedArea(lab.outlineOf(detection.rooms[0])), 120.0);
}

TEST(RoomDetector, RoomThatWasOnlyLookedIntoIsNone) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {4, 2});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  ASSERT_EQ(detection.rooms[0].doorways.size(), 1U);
  EXPECT_FALSE(detection.rooms[0].doorways[0].to) << "leads to what is no room yet";
}

/// A pane that no ray comes back from, in a wall that is known: rays go far beyond it.
TEST(RoomDetector, NoRoomReachesThroughGlass) {
  PlanLab lab;
  lab.addFloor(0.0);
  lab.addWall({0, 0}, {6, 0});
  lab.addWall({6, 0}, {6, 5});
  Face windowed{{6, 5}, {0, 5}, {}};
  lab.addSurfaces({windowed.a, {4.5, 5}, {}});  // between 4.5 and 1.5 there is glass
  lab.addSurfaces({{1.5, 5}, windowed.b, {}});
  WallAttributes attributes;
  attributes.extent_map.outline = {{0, 5, 0}, {6, 5, 0}, {6, 5, 2.7}, {0, 5, 2.7}};
  lab.graph.addWall(windowed.plane(), attributes);
  lab.addWall({0, 5}, {0, 0});
  lab.addSurfaces({{20, 12}, {-14, 12}, {}});  // the house across the street
  lab.walk({1, 2}, {5, 2});
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 1U);
  EXPECT_NEAR(signedArea(lab.outlineOf(detection.rooms[0])), 5.84 * 4.92, 0.5);
}

TEST(RoomDetector, OutdoorsIsNoRoom) {
  PlanLab lab;
  lab.addFloor(0.0);
  lab.addFace({{0, 0}, {12, 0}, {}});         // one facade,
  lab.addSurfaces({{25, 11}, {10, 14}, {}});  // and what may stand in front of it
  lab.walk({2, 3}, {10, 3});
  EXPECT_TRUE(detect(lab).rooms.empty());
}

TEST(RoomDetector, StoreysAreApartAndStairwellsAreKnown) {
  PlanLab lab;
  const FloorId lower = lab.addFloor(0.0);
  addTwoRooms(&lab);
  const FloorId upper = lab.addFloor(3.2);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {9, 2});
  const RoomDetection before = detect(lab);
  ASSERT_EQ(before.rooms.size(), 2U) << "nothing is known of the storey below";
  for (const DetectedRoom& room : before.rooms) EXPECT_EQ(room.kind, Kind::kFourWalls);
  // up through the right room of the upper storey: more of it is stairs than floor
  std::vector<KeyframeId> stairs;
  for (int k = 0; k < 9; ++k) stairs.push_back(lab.stand({6.0 + 0.3 * k, 3.0}, 1.4 + 0.2 * k));
  // and another flight two storeys above the left one, which is none of its business
  for (int k = 0; k < 9; ++k) lab.stand({1.0 + 0.3 * k, 3.0}, 7.4 + 0.2 * k);
  const RoomDetection detection = detect(lab);
  ASSERT_EQ(detection.rooms.size(), 2U);
  for (const DetectedRoom& room : detection.rooms) {
    EXPECT_EQ(room.floor, upper);
    EXPECT_NE(room.floor, lower);
    const bool is_right = lab.graph.pose(room.anchor).translation().x() > 5.0;
    EXPECT_EQ(room.kind, is_right ? Kind::kStairwell : Kind::kFourWalls);
    for (const KeyframeId id : stairs) {
      EXPECT_EQ(std::count(room.keyframes.begin(), room.keyframes.end(), id), 0)
          << "what is on the stairs is in no room";
    }
  }
}

TEST(RoomDetector, IsTheSameStepByStepAndAtOnce) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  RoomDetector detector{RoomDetectorConfig{}};
  RoomDetection last;
  for (int k = 0; k <= 8; ++k) {
    lab.stand({1.0 + k, 2.0});
    last = detector.detect(*lab.graph.snapshot());
  }
  const RoomDetection at_once = detect(lab);
  ASSERT_EQ(last.rooms.size(), at_once.rooms.size());
  for (std::size_t k = 0; k < last.rooms.size(); ++k) {
    EXPECT_EQ(last.rooms[k].keyframes, at_once.rooms[k].keyframes);
    EXPECT_EQ(lab.outlineOf(last.rooms[k]).size(), lab.outlineOf(at_once.rooms[k]).size());
  }
}

TEST(RoomDetector, FollowsKeyframesThatMove) {
  PlanLab lab;
  lab.addFloor(0.0);
  addTwoRooms(&lab);
  lab.walk({1, 2}, {9, 2});
  RoomDetector detector{RoomDetectorConfig{}};
  detector.detect(*lab.graph.snapshot());
  // as after a loop closure: everything is elsewhere
  const Pose way = expPose((Tangent() << 0.8, -0.6, 0.0, 0.0, 0.0, 0.1).finished());
  for (uint32_t k = 0; k < lab.graph.size(Layer::kKeyframe); ++k) {
    const NodeHandle node{Layer::kKeyframe, k};
    lab.graph.setPose(node, way * lab.graph.pose(node));
  }
  for (uint32_t k = 0; k < lab.graph.size(Layer::kWall); ++k) {
    const NodeHandle node{Layer::kWall, k};
    WallAttributes attributes = lab.graph.attributes(WallId{k});
    attributes.extent_map = way * attributes.extent_map;
    lab.graph.setPlane(node, way * lab.graph.plane(node));
    lab.graph.setAttributes(WallId{k}, attributes);
  }
  lab.T_map_world = way;
  const RoomDetection moved = detector.detect(*lab.graph.snapshot());
  ASSERT_EQ(moved.rooms.size(), 2U);
  for (const DetectedRoom& room : moved.rooms) {
    EXPECT_EQ(room.kind, Kind::kFourWalls);
    EXPECT_NEAR(signedArea(lab.outlineOf(room)), (5.0 - kThickness_m) * (4.0 - kThickness_m), 0.1);
  }
}

TEST(RoomDetector, WithoutFloorsThereAreNoRooms) {
  PlanLab lab;
  EXPECT_TRUE(detect(lab).rooms.empty());
  lab.stand({0, 0}, 0.0);
  EXPECT_TRUE(detect(lab).rooms.empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
