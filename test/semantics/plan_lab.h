// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "support/flat_world.h"
#include "support/plane_world.h"

namespace mrpt_sgraphs::test {

/// A building of one storey or more on plan: walls with doors become surfaces that a lidar hits,
/// and nodes of a graph with keyframes that have clouds.
class PlanLab {
 public:
  static constexpr double kSensor_m = 0.8;  ///< Above the ground.
  static constexpr double kDoor_m = 2.1;    ///< High.

  LayeredGraph graph;
  Pose T_map_world = Pose::Identity();

  /// Adds a level. What is added after it stands on it.
  FloorId addFloor(double height_m) {
    ground_m_ = height_m;
    const Plane ground_world{Eigen::Vector3d::UnitZ(), height_m};
    floor_ = graph.addFloor(T_map_world * ground_world, {});
    return floor_;
  }

  /// Both faces of a wall, with doors through it; known to the graph.
  void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
               const std::vector<std::pair<double, double>>& doors = {},
               double thickness_m = 0.16) {
    PlaneWorld plan;
    plan.addWall(a, b, doors, thickness_m);
    for (const Face& face : plan.faces) addFace(face);
  }

  /// Four walls around a box from the origin.
  void addBox(double x_m, double y_m) {
    addWall({0, 0}, {x_m, 0});
    addWall({x_m, 0}, {x_m, y_m});
    addWall({x_m, y_m}, {0, y_m});
    addWall({0, y_m}, {0, 0});
  }

  /// Faces from corner to corner, that look to the left: counter-clockwise, into a room.
  void addFaces(const std::vector<Eigen::Vector2d>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      addFace({corners[k], corners[(k + 1) % corners.size()], {}});
    }
  }

  /// One side of a wall, seen from the left of the way from a to b.
  void addFace(Face face) {
    addSurfaces(face);
    const double top_m = ground_m_ + face.height_m;
    const auto corner = [&](const Eigen::Vector2d& p, double z) -> Eigen::Vector3d {
      return T_map_world * Eigen::Vector3d(p.x(), p.y(), z);
    };
    WallAttributes attributes;
    attributes.floor = floor_;
    attributes.extent_map.outline = {corner(face.b, ground_m_), corner(face.a, ground_m_),
                                     corner(face.a, top_m), corner(face.b, top_m)};
    for (const auto& [from_m, to_m] : face.doors) {
      const Eigen::Vector2d from = face.a + from_m * face.along();
      const Eigen::Vector2d to = face.a + to_m * face.along();
      attributes.extent_map.holes.push_back({corner(to, ground_m_), corner(from, ground_m_),
                                             corner(from, ground_m_ + kDoor_m),
                                             corner(to, ground_m_ + kDoor_m)});
    }
    graph.addWall(T_map_world * face.plane(), attributes);
  }

  /// The surfaces of a face alone: the graph does not know of it.
  void addSurfaces(const Face& face) {
    double from_m = 0.0;
    for (const auto& door : face.doors) {
      addRectangle(face, from_m, door.first, 0.0, face.height_m);
      addRectangle(face, door.first, door.second, kDoor_m, face.height_m);
      from_m = door.second;
    }
    addRectangle(face, from_m, face.length(), 0.0, face.height_m);
  }

  /// A keyframe at a place of the plan, that sees all round. Without a floor it is on stairs.
  KeyframeId stand(const Eigen::Vector2d& at, std::optional<double> height_m = std::nullopt) {
    Pose T_world_base = Pose::Identity();
    T_world_base.translation() << at, height_m.value_or(ground_m_) + kSensor_m;
    std::mt19937 random(7);
    const auto cloud = std::make_shared<Cloud>(
        scanOf(world_, Pattern::spinning(16, 720, -0.26, 0.26), T_world_base, 0.0, &random));
    KeyframeAttributes attributes;
    attributes.stamp_s = 1.0 + static_cast<double>(graph.size(Layer::kKeyframe));
    attributes.cloud = cloud;
    if (!height_m) attributes.floor = floor_;
    return graph.addKeyframe(T_map_world * T_world_base, attributes);
  }

  /// Keyframes every metre from one place to another.
  void walk(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int steps = static_cast<int>(std::ceil((to - from).norm()));
    for (int k = 0; k <= steps; ++k) stand(from + (to - from) * k / std::max(1, steps));
  }

  /// Corners in the world.
  Outline2 outlineOf(const DetectedRoom& room) const {
    const Pose T_world_anchor = T_map_world.inverse() * graph.pose(room.anchor);
    Outline2 outline;
    for (const Eigen::Vector3d& corner : room.extent_anchor.outline) {
      outline.push_back((T_world_anchor * corner).head<2>());
    }
    return outline;
  }

 private:
  void addRectangle(const Face& face, double from_m, double to_m, double bottom_m, double top_m) {
    if (to_m - from_m < 1e-6 || top_m - bottom_m < 1e-6) return;
    const Eigen::Vector2d begin = face.a + from_m * face.along();
    const Eigen::Vector2d way = (to_m - from_m) * face.along();
    world_.rectangles.push_back({{begin.x(), begin.y(), ground_m_ + bottom_m},
                                 {way.x(), way.y(), 0.0},
                                 {0.0, 0.0, top_m - bottom_m}});
  }

  FlatWorld world_;
  FloorId floor_;
  double ground_m_ = 0.0;
};

}  // namespace mrpt_sgraphs::test
