// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "message_check.h"
#include "mrpt_sgraphs/ros/detections.h"

namespace mrpt_sgraphs {
namespace {

template <typename Message, typename Detection>
Message headed(const Detection& detection, const std::string& map_frame) {
  Message msg;
  msg.header.stamp = toRosTime(detection.stamp_s);
  msg.header.frame_id = map_frame;
  return msg;
}

FoundRoom toMsg(const DetectedRoom& room) {
  FoundRoom msg;
  msg.anchor = room.anchor.value;
  msg.pose = toPoseMsg(room.T_anchor_room);
  msg.kind = nameOf(room.kind);
  msg.floor = toIdMsg(room.floor);
  msg.size = {room.size_m.x(), room.size_m.y()};
  msg.height = room.height_m;
  setExtent(room.extent_anchor, &msg);
  for (const BoundingWall& wall : room.walls) {
    msg.walls.emplace_back();
    msg.walls.back().id = wall.id.value;
    tf2::toMsg(wall.axis_room, msg.walls.back().axis);
  }
  msg.keyframes = toIdsMsg(room.keyframes);
  for (const DetectedDoorway& doorway : room.doorways) {
    msg.doorways.emplace_back();
    msg.doorways.back().to =
        doorway.to ? static_cast<std::int64_t>(*doorway.to) : std::int64_t{GraphKeyframe::NONE};
    msg.doorways.back().centre = tf2::toMsg(doorway.centre_anchor);
    msg.doorways.back().width = doorway.width_m;
  }
  return msg;
}

BoundingWall toBoundingWall(const FoundWall& msg, const MessageCheck& check) {
  return {check.id<WallId>(msg.id), check.direction(msg.axis, "the axis of a wall")};
}

DetectedDoorway toDoorway(const FoundDoorway& msg, std::size_t rooms, const MessageCheck& check) {
  DetectedDoorway doorway;
  if (msg.to != GraphKeyframe::NONE) {
    check.require(
        msg.to >= 0 && static_cast<std::size_t>(msg.to) < rooms,
        "a doorway leads to room " + std::to_string(msg.to) + " of " + std::to_string(rooms));
    doorway.to = static_cast<std::size_t>(msg.to);
  }
  doorway.centre_anchor = check.point(msg.centre, "a doorway");
  doorway.width_m = check.length_m(msg.width, "the width of a doorway");
  return doorway;
}

/// @param rooms  In the same message.
DetectedRoom toRoom(const FoundRoom& msg, std::size_t rooms, const MessageCheck& check) {
  DetectedRoom room;
  room.anchor = check.id<KeyframeId>(msg.anchor);
  room.keyframes = check.ids<KeyframeId>(msg.keyframes);
  check.require(!room.keyframes.empty() && room.keyframes.front() == room.anchor,
                "its anchor is not the first of its keyframes");
  room.T_anchor_room = check.pose(msg.pose);
  room.kind = check.kind(msg.kind);
  room.floor = check.idOrNone<FloorId>(msg.floor);
  room.size_m << check.length_m(msg.size[0], "its size"), check.length_m(msg.size[1], "its size");
  room.height_m = check.length_m(msg.height, "its height");
  room.extent_anchor = check.extent(msg);
  for (const FoundWall& wall : msg.walls) room.walls.push_back(toBoundingWall(wall, check));
  for (const FoundDoorway& doorway : msg.doorways) {
    room.doorways.push_back(toDoorway(doorway, rooms, check));
  }
  return room;
}

}  // namespace

Rooms toMsg(const RoomDetection& detection, const std::string& map_frame) {
  Rooms msg = headed<Rooms>(detection, map_frame);
  for (const DetectedRoom& room : detection.rooms) msg.rooms.push_back(toMsg(room));
  return msg;
}

Floors toMsg(const FloorDetection& detection, const std::string& map_frame) {
  Floors msg = headed<Floors>(detection, map_frame);
  for (const DetectedFloor& floor : detection.floors) {
    msg.floors.emplace_back();
    msg.floors.back().id = floor.id.value;
    msg.floors.back().keyframes = toIdsMsg(floor.keyframes);
    msg.floors.back().walls = toIdsMsg(floor.walls);
  }
  for (const DetectedConnection& connection : detection.connections) {
    msg.connections.emplace_back();
    msg.connections.back().from = connection.from.value;
    msg.connections.back().to = connection.to.value;
    msg.connections.back().keyframes = toIdsMsg(connection.keyframes);
  }
  for (const auto& [older, newer] : detection.same) {
    msg.same.emplace_back();
    msg.same.back().older = older.value;
    msg.same.back().newer = newer.value;
  }
  return msg;
}

RoomDetection toRoomDetection(const Rooms& msg) {
  RoomDetection detection;
  detection.stamp_s = msg.header.stamp.toSec();
  for (const FoundRoom& room : msg.rooms) {
    const MessageCheck check("found room " + std::to_string(detection.rooms.size()));
    detection.rooms.push_back(toRoom(room, msg.rooms.size(), check));
  }
  return detection;
}

FloorDetection toFloorDetection(const Floors& msg) {
  FloorDetection detection;
  detection.stamp_s = msg.header.stamp.toSec();
  for (const FoundFloor& floor : msg.floors) {
    const MessageCheck check("found floor " + std::to_string(floor.id));
    detection.floors.push_back({check.id<FloorId>(floor.id), check.ids<KeyframeId>(floor.keyframes),
                                check.ids<WallId>(floor.walls)});
  }
  const MessageCheck connection_check("a connection of floors");
  for (const FoundConnection& connection : msg.connections) {
    detection.connections.push_back({connection_check.id<FloorId>(connection.from),
                                     connection_check.id<FloorId>(connection.to),
                                     connection_check.ids<KeyframeId>(connection.keyframes)});
  }
  const MessageCheck same_check("two nodes of one floor");
  for (const SameFloor& same : msg.same) {
    same_check.require(same.older != same.newer, "they are one node");
    detection.same.emplace_back(same_check.id<FloorId>(same.older),
                                same_check.id<FloorId>(same.newer));
  }
  return detection;
}

}  // namespace mrpt_sgraphs
