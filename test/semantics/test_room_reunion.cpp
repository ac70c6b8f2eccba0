// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/room_reunion.h"

namespace mrpt_sgraphs {
namespace {

using Kind = RoomAttributes::Kind;
constexpr double kMaxChi2 = 22.5;

/// An office on a corridor, and a way that leads back to it with a drift: the map has both twice.
struct SeenTwice {
  explicit SeenTwice(double sigma_m = 0.2) : sigma_m(sigma_m) {
    drift.linear() = expSO3({0.0, 0.0, 0.04});
    drift.translation() << 0.9, -0.6, 0.0;
    floor = graph.addFloor(Plane{}, {});
    corridor = addRoom({0.0, -2.0, 20.0, 0.0}, Pose::Identity(), Kind::kCorridor);
    office = addRoom({2.0, 0.2, 6.0, 3.2}, Pose::Identity());
    join(office, corridor, {4.0, 0.1, 0.0}, Pose::Identity());
    addKeyframe({4.0, 1.0, 1.0}, Pose::Identity(), office);
    addKeyframe({4.0, -1.0, 1.0}, Pose::Identity(), corridor);
  }

  /// ... and back again.
  void comeBack() {
    other_corridor = addRoom({0.0, -2.0, 20.0, 0.0}, drift, Kind::kCorridor);
    other_office = addRoom({2.0, 0.2, 6.0, 3.2}, drift);
    join(other_office, other_corridor, {4.0, 0.1, 0.0}, drift);
    addKeyframe({3.5, 1.5, 1.0}, drift, other_office);
  }

  RoomId addRoom(const Eigen::Vector4d& box, const Pose& T_map_true, Kind kind = Kind::kFourWalls) {
    RoomAttributes room;
    room.kind = kind;
    room.floor = floor;
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(box(0), box(1)), Eigen::Vector2d(box(2), box(1)),
          Eigen::Vector2d(box(2), box(3)), Eigen::Vector2d(box(0), box(3))}) {
      room.extent_map.outline.push_back(T_map_true * Eigen::Vector3d(corner.x(), corner.y(), 0.0));
    }
    Pose T_true_room = Pose::Identity();
    T_true_room.translation() << 0.5 * (box(0) + box(2)), 0.5 * (box(1) + box(3)), 0.0;
    return graph.addRoom(T_map_true * T_true_room, room);
  }

  void join(RoomId a, RoomId b, const Eigen::Vector3d& centre, const Pose& T_map_true) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      RoomAttributes room = graph.attributes(from);
      room.doorways.push_back({to, T_map_true * centre, 0.9});
      graph.setAttributes(from, room);
    }
  }

  void addKeyframe(const Eigen::Vector3d& at, const Pose& T_map_true, RoomId room) {
    Pose T_true_base = Pose::Identity();
    T_true_base.translation() = at;
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(graph.size(Layer::kKeyframe));
    attributes.floor = floor;
    attributes.room = room;
    const KeyframeId id = graph.addKeyframe(T_map_true * T_true_base, attributes);
    truth.push_back(T_true_base);
    if (id.value == 0) return;
    const KeyframeId last{id.value - 1};
    Tangent variance = Tangent::Constant(sigma_m * sigma_m);
    variance.tail<3>() *= 0.01;
    graph.addFactor(
        std::make_shared<RelativePoseFactor>(last, id, graph.pose(last).inverse() * graph.pose(id),
                                             Matrix6(variance.cwiseInverse().asDiagonal())));
  }

  std::optional<RoomReunion> find() const { return findReunion(*graph.snapshot(), kMaxChi2); }

  LayeredGraph graph;
  Pose drift = Pose::Identity();
  double sigma_m;
  FloorId floor;
  RoomId corridor, office, other_corridor, other_office;
  std::vector<Pose> truth;
};

TEST(RoomReunion, ARoomThatTheMapHasTwiceIsRecognized) {
  SeenTwice world;
  EXPECT_FALSE(world.find());
  world.comeBack();
  const auto found = world.find();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->older, world.office);
  EXPECT_EQ(found->younger, world.other_office);
  const Pose expected = world.truth[found->keyframe.value].inverse() * world.truth.back();
  EXPECT_NEAR(local(expected, found->T_keyframe_newest).norm(), 0.0, 1e-6);
}

TEST(RoomReunion, TheNextRoomAlongTheCorridorIsAnotherOne) {
  SeenTwice world(2.0);  // a drift of a room's width would be no surprise
  const RoomId next = world.addRoom({6.2, 0.2, 10.2, 3.2}, Pose::Identity());
  world.join(next, world.corridor, {8.2, 0.1, 0.0}, Pose::Identity());
  world.addKeyframe({8.2, 1.0, 1.0}, Pose::Identity(), next);
  EXPECT_FALSE(world.find());
}

TEST(RoomReunion, AMapThatIsSurerThanTheDriftIsRight) {
  SeenTwice world(0.01);
  world.comeBack();
  EXPECT_FALSE(world.find());
}

TEST(RoomReunion, WhereTwoRoomsFitNoneIsTaken) {
  SeenTwice world(2.0);
  const RoomId next = world.addRoom({6.2, 0.2, 10.2, 3.2}, Pose::Identity());
  world.join(next, world.corridor, {8.2, 0.1, 0.0}, Pose::Identity());
  world.addKeyframe({8.2, 1.0, 1.0}, Pose::Identity(), next);
  world.comeBack();
  EXPECT_FALSE(world.find());
}

TEST(RoomReunion, ARoomOfAnotherShapeOrWithOtherDoorwaysIsAnotherOne) {
  SeenTwice longer;
  longer.other_corridor = longer.addRoom({0.0, -2.0, 20.0, 0.0}, longer.drift, Kind::kCorridor);
  longer.other_office = longer.addRoom({2.0, 0.2, 8.0, 3.2}, longer.drift);
  longer.join(longer.other_office, longer.other_corridor, {4.0, 0.1, 0.0}, longer.drift);
  longer.addKeyframe({3.5, 1.5, 1.0}, longer.drift, longer.other_office);
  EXPECT_FALSE(longer.find());

  SeenTwice other_door;
  other_door.other_corridor =
      other_door.addRoom({0.0, -2.0, 20.0, 0.0}, other_door.drift, Kind::kCorridor);
  other_door.other_office = other_door.addRoom({2.0, 0.2, 6.0, 3.2}, other_door.drift);
  other_door.join(other_door.other_office, other_door.other_corridor, {2.8, 0.1, 0.0},
                  other_door.drift);
  other_door.addKeyframe({3.5, 1.5, 1.0}, other_door.drift, other_door.other_office);
  EXPECT_FALSE(other_door.find());
}

}  // namespace
}  // namespace mrpt_sgraphs
