// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/ros/detections.h"
#include "some_rooms.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kStampRounding_s = 1e-6;

void expectEqual(const PlanarExtent& a, const PlanarExtent& b) {
  EXPECT_EQ(a.outline, b.outline);
  EXPECT_EQ(a.holes, b.holes);
}

TEST(Detections, RoomsComeBackAsTheyWere) {
  const RoomDetection detection = test::twoDetectedRooms();
  const Rooms msg = toMsg(detection, "map");
  EXPECT_EQ(msg.header.frame_id, "map");
  const RoomDetection back = toRoomDetection(msg);
  EXPECT_NEAR(back.stamp_s, detection.stamp_s, kStampRounding_s);
  ASSERT_EQ(back.rooms.size(), detection.rooms.size());
  for (std::size_t k = 0; k < detection.rooms.size(); ++k) {
    const DetectedRoom& a = detection.rooms[k];
    const DetectedRoom& b = back.rooms[k];
    EXPECT_EQ(a.anchor, b.anchor);
    EXPECT_TRUE(a.T_anchor_room.isApprox(b.T_anchor_room, 1e-12));
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.floor, b.floor);
    EXPECT_EQ(a.size_m, b.size_m);
    expectEqual(a.extent_anchor, b.extent_anchor);
    EXPECT_EQ(a.height_m, b.height_m);
    EXPECT_EQ(a.keyframes, b.keyframes);
    ASSERT_EQ(a.walls.size(), b.walls.size());
    for (std::size_t w = 0; w < a.walls.size(); ++w) {
      EXPECT_EQ(a.walls[w].id, b.walls[w].id);
      EXPECT_EQ(a.walls[w].axis_room, b.walls[w].axis_room);
    }
    ASSERT_EQ(a.doorways.size(), b.doorways.size());
    for (std::size_t d = 0; d < a.doorways.size(); ++d) {
      EXPECT_EQ(a.doorways[d].to, b.doorways[d].to);
      EXPECT_EQ(a.doorways[d].centre_anchor, b.doorways[d].centre_anchor);
      EXPECT_EQ(a.doorways[d].width_m, b.doorways[d].width_m);
    }
  }
}

/// What is said of the two rooms after `spoil`; empty if they are taken.
std::string refusalOf(const std::function<void(Rooms&)>& spoil) {
  Rooms msg = toMsg(test::twoDetectedRooms(), "map");
  spoil(msg);
  try {
    toRoomDetection(msg);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Detections, RefuseRoomsThatAreNoneWithASentence) {
  const double nan = std::nan("");
  EXPECT_EQ(refusalOf([](Rooms&) {}), "");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[1].pose.orientation.w = 7.0; }),
            "found room 1: its pose is none");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].kind = "hall"; }),
            "found room 0: 'hall' is no kind of room");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[1].doorways[0].to = 2; }),
            "found room 1: a doorway leads to room 2 of 2");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[1].doorways[0].to = -2; }),
            "found room 1: a doorway leads to room -2 of 2");
  EXPECT_EQ(refusalOf([nan](Rooms& msg) { msg.rooms[0].doorways[0].centre.x = nan; }),
            "found room 0: a doorway is not finite");
  EXPECT_EQ(refusalOf([nan](Rooms& msg) { msg.rooms[0].doorways[0].width = nan; }),
            "found room 0: the width of a doorway is nan m");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].keyframes.clear(); }),
            "found room 0: its anchor is not the first of its keyframes");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].anchor = 1; }),
            "found room 0: its anchor is not the first of its keyframes");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].walls[1].axis.y = 0.9; }),
            "found room 0: the axis of a wall has not length 1");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].height = -1.0; }),
            "found room 0: its height is -1.000000 m");
  EXPECT_EQ(refusalOf([nan](Rooms& msg) { msg.rooms[0].holes[0].points[1].z = nan; }),
            "found room 0: a corner of it is not finite");
  EXPECT_EQ(refusalOf([](Rooms& msg) { msg.rooms[0].floor = -2; }),
            "found room 0: an id of it is none");
  EXPECT_EQ(refusalOf([](Rooms& msg) {
              msg.rooms[0].walls[0].id = std::numeric_limits<std::uint64_t>::max();
            }),
            "found room 0: an id of it is none");
}

TEST(Detections, FloorsComeBackAsTheyWere) {
  const FloorDetection detection = test::twoDetectedFloors();
  const FloorDetection back = toFloorDetection(toMsg(detection, "map"));
  EXPECT_NEAR(back.stamp_s, detection.stamp_s, kStampRounding_s);
  ASSERT_EQ(back.floors.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(back.floors[k].id, detection.floors[k].id);
    EXPECT_EQ(back.floors[k].keyframes, detection.floors[k].keyframes);
    EXPECT_EQ(back.floors[k].walls, detection.floors[k].walls);
  }
  ASSERT_EQ(back.connections.size(), 1U);
  EXPECT_EQ(back.connections[0].from, FloorId{0});
  EXPECT_EQ(back.connections[0].to, FloorId{3});
  EXPECT_EQ(back.connections[0].keyframes, detection.connections[0].keyframes);
  EXPECT_EQ(back.same, detection.same);
}

TEST(Detections, RefuseFloorsThatAreNone) {
  Floors msg = toMsg(test::twoDetectedFloors(), "map");
  msg.same[0].newer = msg.same[0].older;
  EXPECT_THROW(toFloorDetection(msg), std::invalid_argument);
  msg = toMsg(test::twoDetectedFloors(), "map");
  msg.floors[1].keyframes[0] = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW(toFloorDetection(msg), std::invalid_argument);
}

TEST(Detections, AGraphComesBackWithoutItsFactors) {
  GraphSnapshot graph = test::twoRoomsOnTwoFloors();
  graph.T_map_odom = test::somePose(0.7);
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    KeyframeNode& node = graph.keyframes.edit(k);
    node.T_odom_base = graph.T_map_odom.inverse() * node.T_map_base;
  }
  const GraphSnapshot back = toSnapshot(toMsg(graph, "map"));
  EXPECT_NEAR(back.stamp_s, graph.stamp_s, kStampRounding_s);
  EXPECT_TRUE(back.T_map_odom.isApprox(graph.T_map_odom, 1e-9));
  EXPECT_TRUE(back.factors.empty());

  ASSERT_EQ(back.keyframes.size(), graph.keyframes.size());
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    const KeyframeNode& a = graph.keyframes[k];
    const KeyframeNode& b = back.keyframes[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_NEAR(a.stamp_s, b.stamp_s, kStampRounding_s);
    EXPECT_TRUE(a.T_map_base.isApprox(b.T_map_base, 1e-12));
    EXPECT_TRUE(a.T_odom_base.isApprox(b.T_odom_base, 1e-12));
    EXPECT_EQ(a.floor, b.floor);
    EXPECT_EQ(a.room, b.room);
    EXPECT_EQ(a.marginalized, b.marginalized);
    EXPECT_EQ(a.representative, b.representative);
  }
  ASSERT_EQ(back.walls.size(), graph.walls.size());
  for (std::size_t k = 0; k < graph.walls.size(); ++k) {
    EXPECT_EQ(back.walls[k].id, graph.walls[k].id);
    EXPECT_EQ(back.walls[k].plane_map.normal, graph.walls[k].plane_map.normal);
    EXPECT_EQ(back.walls[k].plane_map.distance, graph.walls[k].plane_map.distance);
    EXPECT_EQ(back.walls[k].floor, graph.walls[k].floor);
    expectEqual(back.walls[k].extent_map, graph.walls[k].extent_map);
  }
}

TEST(Detections, AGraphComesBackWithItsRoomsAndFloors) {
  const GraphSnapshot graph = test::twoRoomsOnTwoFloors();
  const SituationalGraph msg = toMsg(graph, "map");
  EXPECT_EQ(msg.rooms[0].keyframes, (std::vector<std::uint64_t>{0, 1}));
  EXPECT_EQ(msg.floors[0].rooms, (std::vector<std::uint64_t>{2, 5}));
  EXPECT_TRUE(msg.floors[1].rooms.empty());

  const GraphSnapshot back = toSnapshot(msg);
  ASSERT_EQ(back.rooms.size(), graph.rooms.size());
  for (std::size_t k = 0; k < graph.rooms.size(); ++k) {
    const RoomNode& a = graph.rooms[k];
    const RoomNode& b = back.rooms[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_TRUE(a.T_map_room.isApprox(b.T_map_room, 1e-12));
    EXPECT_EQ(a.size_m, b.size_m);
    EXPECT_EQ(a.height_m, b.height_m);
    EXPECT_EQ(a.walls, b.walls);
    EXPECT_EQ(a.floor, b.floor);
    expectEqual(a.extent_map, b.extent_map);
    ASSERT_EQ(a.doorways.size(), b.doorways.size());
    for (std::size_t d = 0; d < a.doorways.size(); ++d) {
      EXPECT_EQ(a.doorways[d].to, b.doorways[d].to);
      EXPECT_EQ(a.doorways[d].centre_map, b.doorways[d].centre_map);
      EXPECT_EQ(a.doorways[d].width_m, b.doorways[d].width_m);
    }
  }
  ASSERT_EQ(back.floors.size(), graph.floors.size());
  EXPECT_EQ(back.floors[0].name, "ground");
  EXPECT_EQ(back.floors[0].centre_map, graph.floors[0].centre_map);
  EXPECT_EQ(back.floors[1].ground_map.distance, 2.5);
  ASSERT_EQ(back.floors[0].connections.size(), 1U);
  EXPECT_EQ(back.floors[0].connections[0].to, FloorId{1});
  EXPECT_EQ(back.floors[0].connections[0].here_map, Eigen::Vector3d(5.0, 4.0, -0.5));
  EXPECT_EQ(back.floors[0].connections[0].there_map, Eigen::Vector3d(9.0, 4.0, 2.5));
}

TEST(Detections, RefuseAGraphThatIsNoneAndNameTheNode) {
  const auto refusal = [](const std::function<void(SituationalGraph&)>& spoil) -> std::string {
    SituationalGraph msg = toMsg(test::twoRoomsOnTwoFloors(), "map");
    spoil(msg);
    try {
      toSnapshot(msg);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  using Graph = SituationalGraph;
  EXPECT_EQ(refusal([](Graph&) {}), "");
  EXPECT_EQ(refusal([](Graph& msg) { msg.keyframes[2].pose.orientation.w = 9.0; }),
            "keyframe 2: its pose is none");
  EXPECT_EQ(refusal([](Graph& msg) { msg.keyframes[2].id = 1; }), "keyframe 1: it is there twice");
  EXPECT_EQ(refusal([](Graph& msg) { msg.walls[1].normal.x = 1.0; }), "wall 9: its plane is none");
  EXPECT_EQ(refusal([](Graph& msg) { msg.rooms[1].kind = ""; }), "room 5: '' is no kind of room");
  EXPECT_EQ(refusal([](Graph& msg) { msg.floors[0].centre.z = std::nan(""); }),
            "floor 0: its centre is not finite");
}

TEST(Detections, AReportNamesTheKeyframesInRuns) {
  OptimizationSummary summary;
  for (const std::uint64_t id : {1, 2, 3, 7, 9, 10}) summary.free_keyframes.add(KeyframeId{id});
  summary.fixed_keyframes.add(KeyframeId{0});
  const OptimizationReport msg = toMsg(summary, "map");
  EXPECT_EQ(msg.free_keyframes, (std::vector<std::uint64_t>{1, 3, 7, 7, 9, 10}));
  EXPECT_EQ(msg.fixed_keyframes, (std::vector<std::uint64_t>{0, 0}));
  EXPECT_TRUE(summary.free_keyframes.contains(KeyframeId{2}));
  EXPECT_FALSE(summary.free_keyframes.contains(KeyframeId{8}));
}

}  // namespace
}  // namespace mrpt_sgraphs
