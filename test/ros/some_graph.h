// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs::test {

inline Pose somePose(double x) {
  Tangent tangent;
  tangent << x, -2.0, 0.5, 0.1, -0.2, 0.3 * x;
  return expPose(tangent);
}

inline GraphSnapshot threeKeyframes() {
  GraphSnapshot graph;
  graph.stamp_s = 1600000000.3;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const double x = static_cast<double>(i);
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{i};
    keyframe.stamp_s = 1600000000.0 + 0.1 * x;
    keyframe.T_map_base = keyframe.T_odom_base = somePose(x);
    graph.keyframes.push_back(keyframe);
  }
  const auto add = [&graph](std::uint64_t from, std::uint64_t to, RelativePoseFactor::Kind kind) {
    graph.factors.push_back(
        {FactorId{graph.factors.size()},
         std::make_shared<RelativePoseFactor>(KeyframeId{from}, KeyframeId{to}, Pose::Identity(),
                                              Matrix6::Identity(), kind)});
  };
  add(0, 1, RelativePoseFactor::Kind::kOdometry);
  add(1, 2, RelativePoseFactor::Kind::kOdometry);
  add(0, 2, RelativePoseFactor::Kind::kLoopClosure);
  return graph;
}

/// The three keyframes, in a room with a floor: wall 4, x = 3 with a door, seen by the first two
/// keyframes, and wall 9, y = 2, whose extent is not known yet.
inline GraphSnapshot threeKeyframesBetweenWalls() {
  GraphSnapshot graph = threeKeyframes();
  WallNode wall;
  wall.id = WallId{4};
  wall.plane_map = {-Eigen::Vector3d::UnitX(), -3.0};
  wall.extent_map.outline = {{3, 2, 0}, {3, -2, 0}, {3, -2, 2.5}, {3, 2, 2.5}};
  wall.extent_map.holes = {{{3, 1, 0}, {3, 0, 0}, {3, 0, 2}, {3, 1, 2}}};
  graph.walls.push_back(wall);
  wall = WallNode();
  wall.id = WallId{9};
  wall.plane_map = {-Eigen::Vector3d::UnitY(), -2.0};
  graph.walls.push_back(wall);
  FloorNode floor;
  floor.id = FloorId{0};
  floor.ground_map = {Eigen::Vector3d::UnitZ(), -0.5};
  floor.centre_map << 1.0, 0.5, -0.5;
  graph.floors.push_back(floor);

  const auto see = [&graph](std::uint64_t keyframe, NodeId surface) {
    graph.factors.push_back(
        {FactorId{graph.factors.size()},
         std::make_shared<PlaneObservationFactor>(KeyframeId{keyframe}, surface, Plane{},
                                                  Eigen::Matrix3d::Identity())});
  };
  see(0, WallId{4});
  see(1, WallId{4});
  see(0, FloorId{0});
  return graph;
}

}  // namespace mrpt_sgraphs::test
