// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/semantics/room_layer.h"

namespace mrpt_sgraphs::test {

/// A hand-made storey: rooms with walls of any number and direction, keyframes in them that see the
/// walls of their room with noise, odometry between them, and a ground. The map is turned and
/// shifted against the world as wanted.
class RoomLab {
 public:
  explicit RoomLab(const RoomLayerConfig& config = {}, const Pose& T_map_world = Pose::Identity())
      : layer(config), T_map_world(T_map_world) {
    floor = graph.addFloor(T_map_world * Plane{}, {});
  }

  /// The walls around a ground of corners in the world, counter-clockwise.
  std::vector<WallId> addWalls(const std::vector<Eigen::Vector2d>& corners) {
    std::vector<WallId> walls;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d along = (corners[(k + 1) % corners.size()] - corners[k]).normalized();
      const Eigen::Vector3d normal(-along.y(), along.x(), 0.0);
      const Plane plane_world{normal, normal.head<2>().dot(corners[k])};
      true_walls.push_back(plane_world);
      walls.push_back(graph.addWall(T_map_world * plane_world, {}));
    }
    return walls;
  }

  /// A keyframe that sees some walls and the ground.
  KeyframeId addKeyframe(const Eigen::Vector2d& at, const std::vector<WallId>& walls) {
    Pose T_world_base = Pose::Identity();
    T_world_base.translation() << at, 1.0;
    T_world_base.linear() = expSO3({0.0, 0.0, 0.4 * static_cast<double>(truth.size())});
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(truth.size());
    const KeyframeId id = graph.addKeyframe(T_map_world * T_world_base, attributes);
    if (!truth.empty()) {
      const KeyframeId last{id.value - 1};
      Tangent sigma = Tangent::Constant(0.01);
      sigma.tail<3>().setConstant(odometry_sigma_rad);
      graph.addFactor(std::make_shared<RelativePoseFactor>(
          last, id, retract(truth.back().inverse() * T_world_base, sigma.cwiseProduct(noise<6>())),
          Matrix6(sigma.cwiseAbs2().cwiseInverse().asDiagonal())));
    }
    truth.push_back(T_world_base);
    observe(id, floor, Plane{}, 0.0005);
    for (const WallId wall : walls) observe(id, wall, true_walls[wall.value], sight_sigma_rad);
    return id;
  }

  /// A room of a detection that is right: what stands at a right angle is along its axes.
  DetectedRoom detected(const std::vector<Eigen::Vector2d>& corners,
                        const std::vector<WallId>& walls, const std::vector<KeyframeId>& keyframes,
                        RoomAttributes::Kind kind = RoomAttributes::Kind::kFourWalls) const {
    Eigen::AlignedBox2d box;
    const Eigen::Vector2d x = (corners[1] - corners[0]).normalized();
    Eigen::Matrix3d R;
    R << x.x(), -x.y(), 0.0, x.y(), x.x(), 0.0, 0.0, 0.0, 1.0;
    for (const Eigen::Vector2d& corner : corners) {
      box.extend((R.transpose() * Eigen::Vector3d(corner.x(), corner.y(), 0.0)).head<2>());
    }
    Pose T_world_room = Pose::Identity();
    T_world_room.linear() = R;
    T_world_room.translation() = R * Eigen::Vector3d(box.center().x(), box.center().y(), 0.0);

    DetectedRoom room;
    room.anchor = keyframes.front();
    room.keyframes = keyframes;
    room.kind = kind;
    room.floor = floor;
    room.size_m = box.sizes();
    room.height_m = 2.5;
    const Pose T_anchor_world = truth[room.anchor.value].inverse();
    room.T_anchor_room = T_anchor_world * T_world_room;
    for (const Eigen::Vector2d& corner : corners) {
      room.extent_anchor.outline.push_back(T_anchor_world *
                                           Eigen::Vector3d(corner.x(), corner.y(), 0.0));
    }
    for (const WallId wall : walls) {
      room.walls.push_back({wall, R.transpose() * true_walls[wall.value].normal});
    }
    return room;
  }

  RoomDetection detection(const std::vector<DetectedRoom>& rooms) const {
    return {static_cast<double>(truth.size()) - 1.0, rooms};
  }

  void optimize() {
    layer.mend(&graph);
    optimizeSelection(selectAll(graph), OptimizerConfig(), &optimizer_, &graph);
    layer.follow(&graph);
  }

  /// Mean angle of the walls' normals from the true ones, the map taken from the first keyframe
  /// [rad].
  double normalError_rad(const std::vector<WallId>& walls) const {
    double sum = 0.0;
    for (const WallId wall : walls) {
      const Eigen::Vector3d normal_world =
          T_map_world.linear().transpose() * graph.plane(wall).normal;
      sum += std::asin(normal_world.cross(true_walls[wall.value].normal).norm());
    }
    return sum / static_cast<double>(walls.size());
  }

  std::vector<RoomId> rooms() const {
    std::vector<RoomId> ids;
    for (const RoomNode& room : graph.snapshot()->rooms) ids.push_back(room.id);
    return ids;
  }

  std::size_t count(const std::string& type) const {
    std::size_t result = 0;
    for (const StoredFactor& stored : graph.snapshot()->factors) {
      if (stored.factor->type() == type) ++result;
    }
    return result;
  }

  LayeredGraph graph;
  RoomLayer layer;
  Pose T_map_world;
  FloorId floor;
  std::vector<Plane> true_walls;  ///< In the world, by their ids.
  std::vector<Pose> truth;        ///< T_world_base of the keyframes.
  double sight_sigma_rad = 0.002;
  double odometry_sigma_rad = 0.002;

 private:
  template <int Rows>
  Eigen::Matrix<double, Rows, 1> noise() {
    Eigen::Matrix<double, Rows, 1> values;
    for (int k = 0; k < Rows; ++k) values(k) = normal_(generator_);
    return values;
  }

  void observe(KeyframeId id, NodeId surface, const Plane& plane_world, double sigma_rad) {
    const Plane seen_base = inverseTimes(truth[id.value], plane_world);
    const Eigen::Vector3d sigma(sigma_rad, sigma_rad, 0.005);
    graph.addFactor(std::make_shared<PlaneObservationFactor>(
        id, surface, retract(seen_base, sigma.cwiseProduct(noise<3>())),
        Eigen::Matrix3d(sigma.cwiseAbs2().cwiseInverse().asDiagonal())));
  }

  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
  Optimizer optimizer_;
};

/// Corners of a rectangle, counter-clockwise.
inline std::vector<Eigen::Vector2d> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

}  // namespace mrpt_sgraphs::test
