// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "graph_messages.h"
#include "node_fields.h"
#include "optimization_log.h"

namespace mrpt_sgraphs {
namespace {

std::string field(NodeId node, const std::string& name) {
  const NodeFields fields = fieldsOf(*test::shown(test::roomsMessage()), node);
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&name](const auto& field) { return field.first == name; });
  EXPECT_NE(found, fields.end()) << nameOf(node) << " has no " << name;
  return found == fields.end() ? std::string() : found->second;
}

TEST(NodeFields, OfAKeyframe) {
  EXPECT_EQ(field(KeyframeId{1}, "id"), "1");
  EXPECT_EQ(field(KeyframeId{1}, "stamp [s]"), "1600000000.100000");
  EXPECT_EQ(field(KeyframeId{1}, "room"), "2");
  EXPECT_EQ(field(KeyframeId{1}, "marginalized"), "yes");
  EXPECT_EQ(field(KeyframeId{1}, "representative"), "0");
  EXPECT_EQ(field(KeyframeId{0}, "stands for"), "1: 1");
  EXPECT_EQ(field(KeyframeId{2}, "floor"), "none");
  EXPECT_EQ(field(KeyframeId{2}, "factors"), "1 condensed, 1 loop_closure, 2 odometry");
}

TEST(NodeFields, OfAPoseInDegrees) {
  SituationalGraph msg = test::roomsMessage();
  auto& q = msg.keyframes[0].pose.orientation;
  q.x = q.y = 0.0;
  q.w = q.z = std::sqrt(0.5);
  const NodeFields fields = fieldsOf(*test::shown(msg), KeyframeId{0});
  const auto angles = std::find_if(fields.begin(), fields.end(), [](const auto& field) {
    return field.first == "pose, yaw pitch roll [deg]";
  });
  ASSERT_NE(angles, fields.end());
  EXPECT_EQ(angles->second, "90.00, 0.00, 0.00");
}

TEST(NodeFields, OfWallRoomAndFloor) {
  EXPECT_EQ(field(WallId{4}, "normal"), "-1.000, 0.000, 0.000");
  EXPECT_EQ(field(WallId{9}, "rooms"), "2: 2, 5");
  EXPECT_EQ(field(WallId{4}, "outline"), "4 corners, 1 holes");
  EXPECT_EQ(field(RoomId{2}, "kind"), "four_walls");
  EXPECT_EQ(field(RoomId{2}, "size [m]"), "4.00 x 3.00");
  EXPECT_EQ(field(RoomId{2}, "walls"), "2: 4, 9");
  EXPECT_EQ(field(RoomId{5}, "doorway"), "to room 2, 1.00 m wide, at 3.000, 0.500, -0.500");
  EXPECT_EQ(field(FloorId{0}, "name"), "ground");
  EXPECT_EQ(field(FloorId{0}, "rooms"), "2: 2, 5");
  EXPECT_EQ(field(FloorId{0}, "keyframes"), "1");
}

TEST(NodeFields, OfANodeThatIsGoneAreNone) {
  const auto graph = test::shown(test::roomsMessage());
  EXPECT_TRUE(fieldsOf(*graph, KeyframeId{77}).empty());
  EXPECT_TRUE(fieldsOf(*graph, RoomId{77}).empty());
}

TEST(OptimizationLog, AddsUpByKind) {
  OptimizationLog log;
  log.add("local", 2.0);
  log.add("local", 6.0);
  log.add("local", 1.0);
  log.add("global", 20.0);
  ASSERT_EQ(log.byKind().size(), 2U);
  const OptimizationLog::Times& local = log.byKind().at("local");
  EXPECT_EQ(local.count, 3U);
  EXPECT_DOUBLE_EQ(local.last_ms, 1.0);
  EXPECT_DOUBLE_EQ(local.mean_ms, 3.0);
  EXPECT_DOUBLE_EQ(local.max_ms, 6.0);
}

}  // namespace
}  // namespace mrpt_sgraphs
