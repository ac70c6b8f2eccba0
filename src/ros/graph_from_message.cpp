// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <string>

#include "message_check.h"
#include "mrpt_sgraphs/ros/detections.h"

namespace mrpt_sgraphs {
namespace {

KeyframeNode toNode(const GraphKeyframe& msg, const MessageCheck& check) {
  KeyframeNode node;
  node.id = check.id<KeyframeId>(msg.id);
  node.stamp_s = msg.stamp.toSec();
  node.T_map_base = check.pose(msg.pose);
  node.T_odom_base = check.pose(msg.odom_pose);
  node.floor = check.idOrNone<FloorId>(msg.floor);
  node.room = check.idOrNone<RoomId>(msg.room);
  node.marginalized = msg.marginalized != 0;
  if (msg.representative != msg.id) {
    node.representative = check.id<KeyframeId>(msg.representative);
  }
  return node;
}

WallNode toNode(const GraphWall& msg, const MessageCheck& check) {
  WallNode node;
  node.id = check.id<WallId>(msg.id);
  node.plane_map = check.plane(msg);
  node.extent_map = check.extent(msg);
  node.floor = check.idOrNone<FloorId>(msg.floor);
  return node;
}

RoomNode toNode(const GraphRoom& msg, const MessageCheck& check) {
  RoomNode node;
  node.id = check.id<RoomId>(msg.id);
  node.name = msg.name;
  node.kind = check.kind(msg.kind);
  node.T_map_room = check.pose(msg.pose);
  node.size_m << check.length_m(msg.size[0], "its size"), check.length_m(msg.size[1], "its size");
  node.height_m = check.length_m(msg.height, "its height");
  node.extent_map = check.extent(msg);
  node.floor = check.idOrNone<FloorId>(msg.floor);
  node.walls = check.ids<WallId>(msg.walls);
  for (const GraphDoorway& line : msg.doorways) {
    Doorway doorway;
    doorway.to = check.idOrNone<RoomId>(line.to);
    doorway.centre_map = check.point(line.centre, "a doorway");
    doorway.width_m = check.length_m(line.width, "the width of a doorway");
    node.doorways.push_back(doorway);
  }
  return node;
}

FloorNode toNode(const GraphFloor& msg, const MessageCheck& check) {
  FloorNode node;
  node.id = check.id<FloorId>(msg.id);
  node.name = msg.name;
  node.ground_map = check.plane(msg);
  node.centre_map = check.point(msg.centre, "its centre");
  for (const GraphFloorConnection& line : msg.connections) {
    node.connections.push_back({check.id<FloorId>(line.to), check.point(line.here, "a connection"),
                                check.point(line.there, "a connection")});
  }
  return node;
}

/// @param layer  "keyframe", as the sentence names its nodes.
template <typename Message, typename Node>
void readLayer(const std::vector<Message>& messages, const std::string& layer,
               SharedVector<Node>* nodes) {
  std::set<std::uint64_t> known;
  for (const Message& msg : messages) {
    const MessageCheck check(layer + " " + std::to_string(msg.id));
    check.require(known.insert(msg.id).second, "it is there twice");
    nodes->push_back(toNode(msg, check));
  }
}

}  // namespace

GraphSnapshot toSnapshot(const SituationalGraph& msg) {
  GraphSnapshot graph;
  graph.stamp_s = msg.header.stamp.toSec();
  readLayer(msg.keyframes, "keyframe", &graph.keyframes);
  readLayer(msg.walls, "wall", &graph.walls);
  readLayer(msg.rooms, "room", &graph.rooms);
  readLayer(msg.floors, "floor", &graph.floors);
  if (!graph.keyframes.empty()) {
    const KeyframeNode& newest = graph.keyframes.back();
    graph.T_map_odom = orthonormalized(newest.T_map_base * newest.T_odom_base.inverse());
  }
  return graph;
}

}  // namespace mrpt_sgraphs
