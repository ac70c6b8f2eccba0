// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <vector>

#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "surface_message.h"

namespace mrpt_sgraphs {
namespace {

GraphKeyframe toMsg(const KeyframeNode& node) {
  GraphKeyframe msg;
  msg.id = node.id.value;
  msg.stamp = toRosTime(node.stamp_s);
  msg.pose = toPoseMsg(node.T_map_base);
  msg.odom_pose = toPoseMsg(node.T_odom_base);
  msg.floor = toIdMsg(node.floor);
  msg.room = toIdMsg(node.room);
  msg.marginalized = node.marginalized;
  msg.representative = node.representative.value_or(node.id).value;
  return msg;
}

GraphWall toMsg(const WallNode& node) {
  GraphWall msg;
  msg.id = node.id.value;
  setSurface(node.plane_map, node.extent_map, &msg);
  msg.floor = toIdMsg(node.floor);
  return msg;
}

GraphDoorway toMsg(const Doorway& doorway) {
  GraphDoorway msg;
  msg.to = toIdMsg(doorway.to);
  msg.centre = tf2::toMsg(doorway.centre_map);
  msg.width = doorway.width_m;
  return msg;
}

GraphRoom toMsg(const RoomNode& node, const std::vector<KeyframeId>& keyframes) {
  GraphRoom msg;
  msg.id = node.id.value;
  msg.name = node.name;
  msg.kind = nameOf(node.kind);
  msg.pose = toPoseMsg(node.T_map_room);
  msg.size = {node.size_m.x(), node.size_m.y()};
  msg.height = node.height_m;
  setExtent(node.extent_map, &msg);
  msg.floor = toIdMsg(node.floor);
  msg.walls = toIdsMsg(node.walls);
  msg.keyframes = toIdsMsg(keyframes);
  for (const Doorway& doorway : node.doorways) msg.doorways.push_back(toMsg(doorway));
  return msg;
}

GraphFloor toMsg(const FloorNode& node, const std::vector<RoomId>& rooms) {
  GraphFloor msg;
  msg.id = node.id.value;
  msg.name = node.name;
  msg.centre = tf2::toMsg(node.centre_map);
  tf2::toMsg(node.ground_map.normal, msg.normal);
  msg.distance = node.ground_map.distance;
  msg.rooms = toIdsMsg(rooms);
  for (const FloorConnection& connection : node.connections) {
    GraphFloorConnection line;
    line.to = connection.to.value;
    line.here = tf2::toMsg(connection.here_map);
    line.there = tf2::toMsg(connection.there_map);
    msg.connections.push_back(line);
  }
  return msg;
}

GraphFactor toMsg(const Factor& factor) {
  GraphFactor msg;
  msg.type = factor.type();
  for (int k = 0; k < factor.nodeCount(); ++k) {
    msg.layers.push_back(static_cast<std::uint8_t>(factor.node(k).layer));
    msg.nodes.push_back(factor.node(k).value);
  }
  return msg;
}

}  // namespace

GraphRoom toMsg(const GraphSnapshot& graph, const RoomNode& room) {
  std::vector<KeyframeId> keyframes;
  for (const KeyframeNode& node : graph.keyframes) {
    if (node.room == room.id) keyframes.push_back(node.id);
  }
  return toMsg(room, keyframes);
}

SituationalGraph toMsg(const GraphSnapshot& graph, const std::string& map_frame) {
  std::map<RoomId, std::vector<KeyframeId>> keyframes_in;
  for (const KeyframeNode& node : graph.keyframes) {
    if (node.room) keyframes_in[*node.room].push_back(node.id);
  }
  std::map<FloorId, std::vector<RoomId>> rooms_on;
  for (const RoomNode& node : graph.rooms) {
    if (node.floor) rooms_on[*node.floor].push_back(node.id);
  }

  SituationalGraph msg;
  msg.header.stamp = toRosTime(graph.stamp_s);
  msg.header.frame_id = map_frame;
  for (const KeyframeNode& node : graph.keyframes) msg.keyframes.push_back(toMsg(node));
  for (const WallNode& node : graph.walls) msg.walls.push_back(toMsg(node));
  for (const RoomNode& node : graph.rooms) msg.rooms.push_back(toMsg(node, keyframes_in[node.id]));
  for (const FloorNode& node : graph.floors) msg.floors.push_back(toMsg(node, rooms_on[node.id]));
  for (const StoredFactor& stored : graph.factors) msg.factors.push_back(toMsg(*stored.factor));
  return msg;
}

}  // namespace mrpt_sgraphs
