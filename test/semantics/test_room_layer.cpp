// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "room_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::rectangle;
using test::RoomLab;
using Kind = RoomAttributes::Kind;

/// Two rooms, 4 m x 3 m and 5 m x 3 m, with two keyframes in each and one doorway.
struct TwoRooms : RoomLab {
  explicit TwoRooms(const Pose& T_map_world = Pose::Identity()) : RoomLab({}, T_map_world) {
    west = addWalls(west_corners);
    east = addWalls(east_corners);
    for (const double x : {1.0, 3.0}) west_keyframes.push_back(addKeyframe({x, 1.0}, west));
    for (const double x : {5.0, 8.0}) east_keyframes.push_back(addKeyframe({x, 1.5}, east));
    optimize();
  }

  RoomDetection both() const {
    RoomDetection found = detection({detected(west_corners, west, west_keyframes),
                                     detected(east_corners, east, east_keyframes)});
    const Eigen::Vector3d door_world(4.1, 1.5, 0.0);
    const Pose T_anchor_world = truth[west_keyframes.front().value].inverse();
    found.rooms[0].doorways.push_back({1, T_anchor_world * door_world, 0.9});
    return found;
  }
  RoomDetection one() const {
    std::vector<KeyframeId> all = west_keyframes;
    all.insert(all.end(), east_keyframes.begin(), east_keyframes.end());
    std::vector<WallId> walls{west[0], east[1], east[2], west[3]};
    return detection({detected(rectangle(0.0, 0.0, 9.2, 3.0), walls, all)});
  }

  std::vector<Eigen::Vector2d> west_corners = rectangle(0.0, 0.0, 4.0, 3.0);
  std::vector<Eigen::Vector2d> east_corners = rectangle(4.2, 0.0, 9.2, 3.0);
  std::vector<WallId> west, east;
  std::vector<KeyframeId> west_keyframes, east_keyframes;
};

TEST(RoomLayer, RoomsComeWithWallsNamesKeyframesAndDoorwaysBothWays) {
  TwoRooms lab;
  EXPECT_TRUE(lab.layer.update(lab.both(), &lab.graph));
  ASSERT_EQ(lab.rooms().size(), 2U);
  const RoomId west = lab.rooms()[0];
  const RoomId east = lab.rooms()[1];
  EXPECT_EQ(lab.graph.attributes(west).name, "room 0");
  EXPECT_EQ(lab.graph.attributes(west).walls, lab.west);
  EXPECT_EQ(lab.graph.attributes(west).floor, lab.floor);
  for (const KeyframeId id : lab.west_keyframes) EXPECT_EQ(lab.graph.attributes(id).room, west);
  for (const KeyframeId id : lab.east_keyframes) EXPECT_EQ(lab.graph.attributes(id).room, east);
  for (const auto& [from, to] : {std::pair{west, east}, std::pair{east, west}}) {
    ASSERT_EQ(lab.graph.attributes(from).doorways.size(), 1U);
    const Doorway& doorway = lab.graph.attributes(from).doorways[0];
    EXPECT_EQ(doorway.to, to);
    EXPECT_NEAR((doorway.centre_map - Eigen::Vector3d(4.1, 1.5, 0.0)).norm(), 0.0, 0.05);
  }
}

TEST(RoomLayer, FourWallsGetTheFactorsThatHoldTheRoomAndNoMore) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  EXPECT_EQ(lab.count("room_wall"), 8U);
  EXPECT_EQ(lab.count("room_centre"), 4U);
  EXPECT_EQ(lab.count("floor_room"), 2U);
  EXPECT_EQ(lab.count("room_pose"), 0U);  // nothing is open
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection(selectAll(lab.graph), {}, &optimizer, &lab.graph).gauge.empty());
}

TEST(RoomLayer, ACorridorIsHeldAlongItselfByAKeyframe) {
  RoomLab lab;
  const auto corners = rectangle(0.0, 0.0, 12.0, 2.0);
  const std::vector<WallId> walls = lab.addWalls(corners);
  const std::vector<WallId> sides{walls[0], walls[2]};
  std::vector<KeyframeId> keyframes;
  for (const double x : {1.0, 5.0, 9.0}) keyframes.push_back(lab.addKeyframe({x, 1.0}, walls));
  lab.layer.update(lab.detection({lab.detected(corners, sides, keyframes, Kind::kCorridor)}),
                   &lab.graph);
  EXPECT_EQ(lab.count("room_wall"), 2U);
  EXPECT_EQ(lab.count("room_centre"), 1U);
  EXPECT_EQ(lab.graph.attributes(lab.rooms()[0]).name, "corridor 0");
  ASSERT_EQ(lab.count("room_pose"), 1U);
  for (const StoredFactor& stored : lab.graph.snapshot()->factors) {
    const auto* pose = dynamic_cast<const RelativePoseFactor*>(stored.factor.get());
    if (pose == nullptr || pose->kind != RelativePoseFactor::Kind::kRoom) continue;
    Matrix6 along = Matrix6::Zero();
    along(0, 0) = pose->information()(0, 0);
    EXPECT_GT(along(0, 0), 1.0);
    EXPECT_NEAR((pose->information() - along).norm(), 0.0, 1e-9);
  }
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection(selectAll(lab.graph), {}, &optimizer, &lab.graph).gauge.empty());
}

TEST(RoomLayer, WithoutFactorsRoomsOnlyGoWithTheirKeyframes) {
  RoomLayerConfig config;
  config.factors = false;
  TwoRooms lab;
  const GraphSnapshotConstPtr before = lab.graph.snapshot();
  lab.layer = RoomLayer(config);
  lab.layer.update(lab.both(), &lab.graph);
  lab.optimize();
  EXPECT_EQ(lab.count("room_pose"), 2U);
  EXPECT_EQ(lab.count("room_wall") + lab.count("room_centre") + lab.count("floor_room"), 0U);
  for (const WallNode& wall : before->walls) {
    EXPECT_NEAR(local(wall.plane_map, lab.graph.plane(wall.id)).norm(), 0.0, 1e-6);
  }
}

TEST(RoomLayer, NothingChangesWhenNothingHasChanged) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  GraphSnapshotConstPtr before = lab.graph.snapshot();
  EXPECT_FALSE(lab.layer.update(lab.both(), &lab.graph));
  EXPECT_EQ(lab.graph.snapshot(), before);
  lab.optimize();
  EXPECT_FALSE(lab.layer.update(lab.both(), &lab.graph));
  before = lab.graph.snapshot();
  EXPECT_FALSE(lab.layer.update(lab.both(), &lab.graph));
  EXPECT_EQ(lab.graph.snapshot(), before);
}

TEST(RoomLayer, ARoomThatGrowsKeepsItsIdAndItsName) {
  TwoRooms lab;
  RoomDetection small = lab.both();
  small.rooms.pop_back();
  small.rooms[0] = lab.detected(rectangle(0.0, 0.0, 2.0, 3.0), {lab.west[0], lab.west[3]},
                                {lab.west_keyframes[0]}, Kind::kPolygon);
  lab.layer.update(small, &lab.graph);
  const RoomId id = lab.rooms().at(0);
  RoomAttributes named = lab.graph.attributes(id);
  named.name = "kitchen";
  lab.graph.setAttributes(id, named);
  RoomDetection grown = lab.both();
  std::swap(grown.rooms[0], grown.rooms[1]);  // their order means nothing
  grown.rooms[1].doorways[0].to = 0;
  EXPECT_TRUE(lab.layer.update(grown, &lab.graph));
  ASSERT_EQ(lab.rooms().size(), 2U);
  EXPECT_EQ(lab.graph.attributes(id).name, "kitchen");
  EXPECT_EQ(lab.graph.attributes(id).walls, lab.west);
  EXPECT_EQ(lab.graph.attributes(id).kind, Kind::kFourWalls);
}

TEST(RoomLayer, RoomsThatAreOneBecomeTheOlderAndTheLargerPartKeepsTheId) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  EXPECT_TRUE(lab.layer.update(lab.one(), &lab.graph));
  ASSERT_EQ(lab.rooms(), std::vector<RoomId>{RoomId{0}});
  for (const KeyframeId id : lab.east_keyframes) {
    EXPECT_EQ(lab.graph.attributes(id).room, RoomId{0});
  }
  lab.layer.update(lab.both(), &lab.graph);
  const std::vector<RoomId> both{RoomId{0}, RoomId{2}};
  ASSERT_EQ(lab.rooms(), both);
  EXPECT_EQ(lab.graph.attributes(RoomId{0}).walls, lab.east);  // 5 m and not 4 m long
  EXPECT_EQ(lab.count("room_wall"), 8U);
}

TEST(RoomLayer, ARoomThatIsNoMoreGoesWithItsFactorsAndItsKeyframesHaveNone) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  RoomDetection found = lab.both();
  found.rooms.pop_back();
  found.rooms[0].doorways.clear();
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(lab.layer.update(found, &lab.graph));
    EXPECT_EQ(lab.rooms().size(), 2U) << "once or twice may be a mistake";
    for (const KeyframeId id : lab.east_keyframes) {
      EXPECT_EQ(lab.graph.attributes(id).room, RoomId{1});
    }
  }
  EXPECT_TRUE(lab.layer.update(found, &lab.graph));
  EXPECT_EQ(lab.rooms(), std::vector<RoomId>{RoomId{0}});
  EXPECT_EQ(lab.count("room_wall"), 4U);
  for (const KeyframeId id : lab.east_keyframes) EXPECT_FALSE(lab.graph.attributes(id).room);
  EXPECT_TRUE(lab.graph.attributes(RoomId{0}).doorways.empty());
}

TEST(RoomLayer, ADetectionMayBeOlderThanTheGraph) {
  TwoRooms lab;
  const RoomDetection stale = lab.both();
  // since then a wall was given up, a keyframe came, and everything has moved
  lab.graph.eraseNode(lab.west[1]);
  const KeyframeId newest = lab.addKeyframe({6.0, 1.5}, {});
  Pose T_new_old = Pose::Identity();
  T_new_old.linear() = expSO3({0.0, 0.0, 0.3});
  T_new_old.translation() << 3.0, -2.0, 0.1;
  for (uint32_t slot = 0; slot < lab.graph.size(Layer::kKeyframe); ++slot) {
    const NodeHandle node{Layer::kKeyframe, slot};
    lab.graph.setPose(node, T_new_old * lab.graph.pose(node));
  }
  for (const Layer layer : {Layer::kWall, Layer::kFloor}) {
    for (uint32_t slot = 0; slot < lab.graph.size(layer); ++slot) {
      const NodeHandle node{layer, slot};
      lab.graph.setPlane(node, T_new_old * lab.graph.plane(node));
    }
  }
  lab.layer.update(stale, &lab.graph);
  const RoomAttributes& west = lab.graph.attributes(RoomId{0});
  EXPECT_EQ(west.walls, (std::vector<WallId>{lab.west[0], lab.west[2], lab.west[3]}));
  EXPECT_NEAR((west.extent_map.outline[2] - T_new_old * Eigen::Vector3d(4.0, 3.0, 0.0)).norm(), 0.0,
              0.05);
  EXPECT_NEAR(
      (lab.graph.pose(RoomId{0}).translation() - T_new_old * Eigen::Vector3d(2.0, 1.5, 0.0)).norm(),
      0.0, 0.05);
  EXPECT_FALSE(lab.graph.attributes(newest).room);
  EXPECT_EQ(lab.count("room_wall"), 7U);
}

TEST(RoomLayer, WhenAWallIsGivenUpTheRoomIsHeldByTheRest) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  lab.graph.eraseNode(lab.west[1]);
  lab.layer.mend(&lab.graph);
  EXPECT_EQ(lab.graph.attributes(RoomId{0}).walls.size(), 3U);
  EXPECT_EQ(lab.count("room_pose"), 1U);
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection(selectAll(lab.graph), {}, &optimizer, &lab.graph).gauge.empty());
}

TEST(RoomLayer, OutlinesAndDoorwaysFollowTheRoom) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  lab.optimize();
  const RoomAttributes before = lab.graph.attributes(RoomId{0});
  Pose T_new_old = Pose::Identity();
  T_new_old.linear() = expSO3({0.0, 0.0, 0.1});
  T_new_old.translation() << 1.0, 2.0, 0.0;
  lab.graph.setPose(RoomId{0}, T_new_old * lab.graph.pose(RoomId{0}));
  lab.layer.follow(&lab.graph);
  const RoomAttributes& after = lab.graph.attributes(RoomId{0});
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR((after.extent_map.outline[k] - T_new_old * before.extent_map.outline[k]).norm(),
                0.0, 1e-9);
  }
  EXPECT_NEAR((after.doorways[0].centre_map - T_new_old * before.doorways[0].centre_map).norm(),
              0.0, 1e-9);
}

TEST(RoomLayer, IsTheSameWhereverTheMapIsAndHoweverItIsTurned) {
  TwoRooms here;
  Pose T_map_world = Pose::Identity();
  T_map_world.linear() = expSO3({0.0, 0.0, M_PI / 4.0});
  T_map_world.translation() << 300.0, -200.0, 4.0;
  TwoRooms there(T_map_world);
  for (TwoRooms* lab : {&here, &there}) {
    lab->layer.update(lab->both(), &lab->graph);
    lab->layer.update(lab->one(), &lab->graph);
    lab->layer.update(lab->both(), &lab->graph);
    lab->optimize();
  }
  EXPECT_EQ(here.rooms(), there.rooms());
  for (const RoomId id : here.rooms()) {
    EXPECT_EQ(here.graph.attributes(id).walls, there.graph.attributes(id).walls);
    EXPECT_NEAR(local(there.graph.pose(id), T_map_world * here.graph.pose(id)).norm(), 0.0, 1e-6);
  }
}

TEST(RoomLayer, TheAxesOfARoomStayWhatTheyAre) {
  TwoRooms lab;
  lab.layer.update(lab.both(), &lab.graph);
  lab.optimize();
  lab.layer.update(lab.both(), &lab.graph);
  const GraphSnapshotConstPtr before = lab.graph.snapshot();
  RoomDetection turned = lab.both();  // the same, with x where y was
  const Eigen::Matrix3d quarter = expSO3({0.0, 0.0, 0.5 * M_PI});
  for (DetectedRoom& room : turned.rooms) {
    room.T_anchor_room.linear() = (room.T_anchor_room.linear() * quarter).eval();
    for (BoundingWall& wall : room.walls) wall.axis_room = quarter.transpose() * wall.axis_room;
    std::swap(room.size_m.x(), room.size_m.y());
  }
  EXPECT_FALSE(lab.layer.update(turned, &lab.graph));
  EXPECT_EQ(lab.graph.snapshot(), before);
}

}  // namespace
}  // namespace mrpt_sgraphs
