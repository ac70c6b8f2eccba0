// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/conversions.h"
#include "surface_message.h"

namespace mrpt_sgraphs {
namespace {

template <typename Layer>
std::int64_t toMsg(const std::optional<Id<Layer>>& id) {
  return id ? static_cast<std::int64_t>(id->value) : std::int64_t{GraphKeyframe::NONE};
}

GraphKeyframe toMsg(const KeyframeNode& node) {
  GraphKeyframe msg;
  msg.id = node.id.value;
  msg.stamp = toRosTime(node.stamp_s);
  msg.pose = toPoseMsg(node.T_map_base);
  msg.floor = toMsg(node.floor);
  msg.room = toMsg(node.room);
  msg.marginalized = node.marginalized;
  msg.representative = node.representative.value_or(node.id).value;
  return msg;
}

GraphWall toMsg(const WallNode& node) {
  GraphWall msg;
  msg.id = node.id.value;
  setSurface(node.plane_map, node.extent_map, &msg);
  msg.floor = GraphKeyframe::NONE;
  return msg;
}

GraphFloor toMsg(const FloorNode& node) {
  GraphFloor msg;
  msg.id = node.id.value;
  msg.centre = tf2::toMsg(node.centre_map);
  tf2::toMsg(node.ground_map.normal, msg.normal);
  msg.distance = node.ground_map.distance;
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

SituationalGraph toMsg(const GraphSnapshot& graph, const std::string& map_frame) {
  SituationalGraph msg;
  msg.header.stamp = toRosTime(graph.stamp_s);
  msg.header.frame_id = map_frame;
  for (const KeyframeNode& node : graph.keyframes) msg.keyframes.push_back(toMsg(node));
  for (const WallNode& node : graph.walls) msg.walls.push_back(toMsg(node));
  for (const FloorNode& node : graph.floors) msg.floors.push_back(toMsg(node));
  for (const StoredFactor& stored : graph.factors) msg.factors.push_back(toMsg(*stored.factor));
  return msg;
}

}  // namespace mrpt_sgraphs
