// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {

/// A corridor along x with two rooms of 6 m x 5 m to its left, doors at x = 3 and x = 9, and a robot
/// that goes along it and through the rooms, a keyframe about every metre. It measures its way and
/// the walls of the room that it is in, with noise. The map is anywhere.
class StoreyLab {
 public:
  enum Place { kCorridor, kFirst, kSecond };

  LayeredGraph graph;
  FloorId floor;
  RoomId rooms[3];                     ///< By place.
  std::vector<WallId> walls[3];        ///< By place.
  std::vector<KeyframeId> keyframes[3];
  std::vector<Pose> truth;             ///< In the world, by keyframe.

  explicit StoreyLab(const Pose& T_map_world = Pose::Identity(), unsigned seed = 7)
      : T_map_world_(T_map_world), random_(seed) {
    floor = graph.addFloor(T_map_world * Plane{}, {});
    addRoom(kCorridor, -4.0, 14.0, -1.2, 1.2);
    addRoom(kFirst, 0.0, 6.0, 1.4, 6.4);
    addRoom(kSecond, 6.2, 12.2, 1.4, 6.4);
  }

  /// From the corridor's end through both rooms and back again.
  void tour() {
    for (double x = -3.0; x < 2.5; x += 1.0) add(kCorridor, x, 0.0);
    visit(kFirst, 3.0);
    for (double x = 4.0; x < 8.5; x += 1.0) add(kCorridor, x, 0.1);
    visit(kSecond, 9.0);
    for (double x = 8.0; x > -3.5; x -= 1.0) add(kCorridor, x, -0.1);
  }

  /// In by the door at x, around and out again.
  void visit(Place place, double x) {
    add(kCorridor, x, 0.0);
    for (const auto& [dx, y] : {std::pair{0.0, 2.0}, {-1.0, 3.0}, {-2.0, 4.0}, {-1.0, 5.0},
                                {0.0, 5.5}, {1.0, 5.0}, {2.0, 4.0}, {1.0, 3.0}, {0.1, 2.2}}) {
      add(place, x + dx, y);
    }
    add(kCorridor, x + 0.2, 0.1);
  }

  KeyframeId add(Place place, double x, double y) {
    Pose T_world_base = Pose::Identity();
    T_world_base.translation() << x + random_.number(0.1), y + random_.number(0.1), 0.8;
    T_world_base.linear() = expSO3({0.0, 0.0, random_.number(3.0)});
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(truth.size());
    attributes.room = rooms[place];
    attributes.floor = floor;
    Pose T_map_base = T_map_world_ * T_world_base;
    if (!truth.empty()) {
      const KeyframeId last{truth.size() - 1};
      const Pose measured = truth.back().inverse() * T_world_base * random_.smallPose(0.02, 0.005);
      T_map_base = orthonormalized(graph.pose(last) * measured);
      const KeyframeId id = graph.addKeyframe(T_map_base, attributes);
      connect(last, id, measured, RelativePoseFactor::Kind::kOdometry);
    } else {
      graph.addKeyframe(T_map_base, attributes);
    }
    const KeyframeId id{truth.size()};
    truth.push_back(T_world_base);
    keyframes[place].push_back(id);
    observe(id, floor, Plane{});
    for (const WallId wall : walls[place]) observe(id, wall, true_walls_[wall.value]);
    return id;
  }

  FactorId connect(KeyframeId from, KeyframeId to, const Pose& measured,
                   RelativePoseFactor::Kind kind) {
    Matrix6 information = Matrix6::Zero();
    information.diagonal() << Eigen::Vector3d::Constant(2500.0), Eigen::Vector3d::Constant(4e4);
    return graph.addFactor(
        std::make_shared<RelativePoseFactor>(from, to, measured, information, kind));
  }

  FactorId close(KeyframeId from, KeyframeId to) {
    const Pose measured = truth[from.value].inverse() * truth[to.value] *
                          random_.smallPose(0.01, 0.003);
    return connect(from, to, measured, RelativePoseFactor::Kind::kLoopClosure);
  }

  OptimizerReport optimize(double min_relative_decrease = 1e-14) {
    OptimizerConfig config;
    config.min_relative_decrease = min_relative_decrease;
    Optimizer optimizer;
    return optimizeSelection(selectAll(graph), config, &optimizer, &graph);
  }

  const Plane& trueWall(WallId wall) const { return true_walls_[wall.value]; }

 private:
  void addRoom(Place place, double x0, double x1, double y0, double y1) {
    const Plane faces[] = {{{1.0, 0.0, 0.0}, x0}, {{-1.0, 0.0, 0.0}, -x1},
                           {{0.0, 1.0, 0.0}, y0}, {{0.0, -1.0, 0.0}, -y1}};
    RoomAttributes attributes;
    for (const Plane& face : faces) {
      WallAttributes wall;
      wall.floor = floor;
      walls[place].push_back(graph.addWall(T_map_world_ * face, wall));
      true_walls_.push_back(face);
    }
    attributes.kind = place == kCorridor ? RoomAttributes::Kind::kCorridor
                                         : RoomAttributes::Kind::kFourWalls;
    attributes.walls = walls[place];
    attributes.floor = floor;
    const auto corner = [&](double x, double y) { return T_map_world_ * Eigen::Vector3d(x, y, 0.0); };
    attributes.extent_map.outline = {corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)};
    Pose T_world_room = Pose::Identity();
    T_world_room.translation() << 0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0;
    rooms[place] = graph.addRoom(T_map_world_ * T_world_room, attributes);
  }

  void observe(KeyframeId id, NodeId surface, const Plane& surface_world) {
    const Plane seen = retract(inverseTimes(truth[id.value], surface_world),
                               PlaneTangent(random_.vector(0.004)));
    const Eigen::Vector3d information(4e4, 4e4, 2500.0);
    graph.addFactor(std::make_shared<PlaneObservationFactor>(
        id, surface, seen, information.asDiagonal().toDenseMatrix()));
  }

  Pose T_map_world_;
  RandomGeometry random_;
  std::vector<Plane> true_walls_;
};

}  // namespace mrpt_sgraphs::test
