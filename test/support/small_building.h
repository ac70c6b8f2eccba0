// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs::test {

/// Two rooms with a door between them, a storey above, and a name that every format has to escape:
///
///     room 0, x 0 to 4, y 0 to 3 | wall of 0.2 m, door at y 1 to 2 | room 1, x 4.2 to 9.2
///
/// The wall's faces are walls 0 (seen from room 0) and 1 (seen from room 1), 2.5 m high, with the
/// door up to 2 m; wall 2, the outer one at x = 9.2, was seen from one side. Room 2 lies above room
/// 0 on floor 1, whose ground is 3 m higher. The keyframes 0 and 1 stand in rooms 0 and 1.
struct SmallBuilding {
  static constexpr const char* kName = "<R&D> \"3\" 'B' \xC3\xBC";

  SmallBuilding() {
    addFloors();
    addWall({-1.0, 0.0, 0.0}, 4.0, true);
    addWall({1.0, 0.0, 0.0}, 4.2, true);
    addWall({-1.0, 0.0, 0.0}, 9.2, false);
    addRoom(0.0, 4.0, 0.0, "room 0", FloorId{0}, {{RoomId{1}, {4.0, 1.5, 0.0}, 1.0}});
    addRoom(4.2, 9.2, 0.0, kName, FloorId{0}, {{RoomId{0}, {4.2, 1.5, 0.0}, 1.0}});
    addRoom(0.0, 4.0, 3.0, "room 2", FloorId{1}, {{std::nullopt, {2.0, 3.0, 3.0}, 0.8}});
    addKeyframe(2.0, RoomId{0});
    addKeyframe(7.0, RoomId{1});
    addFactors();
  }

  GraphSnapshotConstPtr snapshot() const { return graph.snapshot(); }

  LayeredGraph graph;

 private:
  void addFloors() {
    FloorAttributes lower;
    lower.name = "floor 1";
    lower.connections = {{FloorId{1}, {8.0, 2.0, 0.0}, {3.0, 2.0, 3.0}}};
    FloorAttributes upper;
    upper.name = "floor 2";
    upper.connections = {{FloorId{0}, {3.0, 2.0, 3.0}, {8.0, 2.0, 0.0}}};
    graph.addFloor(Plane{Eigen::Vector3d::UnitZ(), 0.0}, lower);
    graph.addFloor(Plane{Eigen::Vector3d::UnitZ(), 3.0}, upper);
  }

  void addWall(const Eigen::Vector3d& normal, double x, bool with_door) {
    WallAttributes wall;
    wall.floor = FloorId{0};
    wall.extent_map.outline = {{x, 0.0, 0.0}, {x, 3.0, 0.0}, {x, 3.0, 2.5}, {x, 0.0, 2.5}};
    if (with_door) {
      wall.extent_map.holes = {{{x, 1.0, 0.0}, {x, 2.0, 0.0}, {x, 2.0, 2.0}, {x, 1.0, 2.0}}};
    }
    graph.addWall(Plane{normal, normal.x() * x}, wall);
  }

  void addRoom(double x0, double x1, double z, const char* name, FloorId floor,
               const std::vector<Doorway>& doorways) {
    RoomAttributes room;
    room.name = name;
    room.floor = floor;
    room.size_m = {x1 - x0, 3.0};
    room.height_m = 2.5;
    room.extent_map.outline = {{x0, 0.0, z}, {x1, 0.0, z}, {x1, 3.0, z}, {x0, 3.0, z}};
    room.doorways = doorways;
    Pose T_map_room = Pose::Identity();
    T_map_room.translation() << 0.5 * (x0 + x1), 1.5, z;
    graph.addRoom(T_map_room, room);
  }

  void addKeyframe(double x, RoomId room) {
    KeyframeAttributes keyframe;
    keyframe.stamp_s = x;
    keyframe.floor = FloorId{0};
    keyframe.room = room;
    Pose T_map_base = Pose::Identity();
    T_map_base.translation() << x, 1.5, 1.0;
    graph.addKeyframe(T_map_base, keyframe);
  }

  /// Of one node, of two and of three; one is shelved.
  void addFactors() {
    const KeyframeId a{0};
    const KeyframeId b{1};
    const Eigen::Matrix3d some = Eigen::Matrix3d::Identity();
    graph.addFactor(std::make_shared<PosePriorFactor>(a, Pose::Identity(), Matrix6::Identity()));
    graph.addFactor(
        std::make_shared<RelativePoseFactor>(a, b, Pose::Identity(), Matrix6::Identity()));
    graph.addFactor(std::make_shared<WallPairFactor>(
        a, WallId{0}, WallId{1}, Eigen::Vector3d(-1.0, 0.0, 0.0), 0.2, some));
    graph.shelve(graph.addFactor(std::make_shared<PlaneObservationFactor>(
                     b, WallId{1}, Plane{Eigen::Vector3d::UnitX(), -2.8}, some)),
                 a);
  }
};

}  // namespace mrpt_sgraphs::test
