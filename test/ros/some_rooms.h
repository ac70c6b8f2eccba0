// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"
#include "some_graph.h"

namespace mrpt_sgraphs::test {

/// The three keyframes between walls, the second marginalized, the room and the corridor that they
/// are in with a doorway between the two, and a storey above with nothing in it but the stairs that
/// lead there.
inline GraphSnapshot twoRoomsOnTwoFloors() {
  GraphSnapshot graph = threeKeyframesBetweenWalls();
  graph.keyframes.edit(1).marginalized = true;
  graph.keyframes.edit(1).representative = KeyframeId{0};
  graph.keyframes.edit(0).room = graph.keyframes.edit(1).room = RoomId{2};
  graph.keyframes.edit(0).floor = FloorId{0};
  graph.walls.edit(0).floor = FloorId{0};

  RoomNode room;
  room.id = RoomId{2};
  room.name = "room 2";
  room.kind = RoomAttributes::Kind::kFourWalls;
  room.T_map_room =
      Eigen::Translation3d(1.0, 0.0, -0.5) * Pose(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  room.walls = {WallId{4}, WallId{9}};
  room.floor = FloorId{0};
  room.size_m << 4.0, 3.0;
  room.height_m = 2.5;
  room.extent_map.outline = {{-1, -2, -0.5}, {3, -2, -0.5}, {3, 2, -0.5}, {-1, 2, -0.5}};
  room.extent_map.holes = {{{0, 0, -0.5}, {0, 1, -0.5}, {1, 1, -0.5}, {1, 0, -0.5}}};
  room.doorways = {{RoomId{5}, {3.0, 0.5, -0.5}, 1.0}, {std::nullopt, {-1.0, 0.0, -0.5}, 0.8}};
  graph.rooms.push_back(room);
  RoomNode corridor;
  corridor.id = RoomId{5};
  corridor.name = "corridor 5";
  corridor.kind = RoomAttributes::Kind::kCorridor;
  corridor.T_map_room.translation() << 4.0, 0.0, -0.5;
  corridor.walls = {WallId{9}};
  corridor.floor = FloorId{0};
  corridor.extent_map.outline = {{3, -5, -0.5}, {5, -5, -0.5}, {5, 5, -0.5}, {3, 5, -0.5}};
  corridor.doorways = {{RoomId{2}, {3.0, 0.5, -0.5}, 1.0}};
  graph.rooms.push_back(corridor);

  FloorNode& ground = graph.floors.edit(0);
  ground.name = "ground";
  ground.connections = {{FloorId{1}, {5.0, 4.0, -0.5}, {9.0, 4.0, 2.5}}};
  FloorNode above;
  above.id = FloorId{1};
  above.ground_map = {Eigen::Vector3d::UnitZ(), 2.5};
  above.centre_map << 9.0, 4.0, 2.5;
  graph.floors.push_back(above);
  return graph;
}

/// As a detector would tell it: the same two rooms.
inline RoomDetection twoDetectedRooms() {
  RoomDetection detection;
  detection.stamp_s = 1600000000.2;
  DetectedRoom room;
  room.anchor = KeyframeId{3};
  room.T_anchor_room = somePose(1.5);
  room.kind = RoomAttributes::Kind::kFourWalls;
  room.floor = FloorId{0};
  room.size_m << 4.0, 3.25;
  room.extent_anchor.outline = {{-1, -2, -0.5}, {3, -2, -0.5}, {3, 2, -0.5}};
  room.extent_anchor.holes = {{{0, 0, -0.5}, {0, 1, -0.5}, {1, 1, -0.5}}};
  room.height_m = 2.75;
  room.walls = {{WallId{4}, -Eigen::Vector3d::UnitX()}, {WallId{9}, {0.6, 0.8, 0.0}}};
  room.keyframes = {KeyframeId{3}, KeyframeId{1}, KeyframeId{7}};
  room.doorways = {{std::size_t{1}, {3.0, 0.5, -0.5}, 1.0}, {std::nullopt, {-1, 0, -0.5}, 0.8}};
  detection.rooms.push_back(room);
  room.kind = RoomAttributes::Kind::kPolygon;
  room.anchor = KeyframeId{8};
  room.keyframes = {KeyframeId{8}};
  room.floor.reset();
  room.walls.clear();
  room.doorways = {{std::size_t{0}, {0.5, 0.5, -0.5}, 1.0}};
  detection.rooms.push_back(room);
  return detection;
}

inline FloorDetection twoDetectedFloors() {
  FloorDetection detection;
  detection.stamp_s = 1600000000.2;
  detection.floors = {{FloorId{0}, {KeyframeId{0}, KeyframeId{1}}, {WallId{4}}},
                      {FloorId{3}, {KeyframeId{7}}, {}}};
  detection.connections = {{FloorId{0}, FloorId{3}, {KeyframeId{5}, KeyframeId{6}}}};
  detection.same = {{FloorId{0}, FloorId{2}}};
  return detection;
}

}  // namespace mrpt_sgraphs::test
