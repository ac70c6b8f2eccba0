// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs::test {

/// One side of a wall: seen from the left of the way from a to b.
struct Face {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
  std::vector<std::pair<double, double>> doors;  ///< From, to along the way from a [m].
  double bottom_m = 0.0;
  double height_m = 2.7;

  double length() const { return (b - a).norm(); }
  Eigen::Vector2d along() const { return (b - a) / length(); }
  Eigen::Vector2d normal() const { return {-along().y(), along().x()}; }
  Plane plane() const {
    return {Eigen::Vector3d(normal().x(), normal().y(), 0.0), normal().dot(a)};
  }
  bool isDoor(double s) const {
    for (const auto& door : doors) {
      if (s > door.first && s < door.second) return true;
    }
    return false;
  }
};

/// How well planes are seen: of the normal, and of the plane at the centroid.
struct PlaneNoise {
  double sigma_rad = 0.004;
  double sigma_m = 0.01;
};

/// A building of faces and what of it is seen from where: pieces in the line of sight, a door as a
/// hole, with noise as their covariances say.
class PlaneWorld {
 public:
  std::vector<Face> faces;
  PlaneNoise noise;
  double range_m = 10.0;

  /// Both faces of a wall around the line from a to b.
  void addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
               const std::vector<std::pair<double, double>>& doors = {},
               double thickness_m = 0.16) {
    Face left{a, b, doors};
    left.a += 0.5 * thickness_m * left.normal();
    left.b = left.a + (b - a);
    Face right{b, a, {}};
    right.a += 0.5 * thickness_m * right.normal();
    right.b = right.a + (a - b);
    for (const auto& door : doors) {
      right.doors.emplace_back(left.length() - door.second, left.length() - door.first);
    }
    faces.push_back(left);
    faces.push_back(right);
  }

  /// What is seen from a pose of the base, at the height of the sensor.
  ObservedPlanesConstPtr observe(const Pose& T_world_base, std::mt19937* generator) const {
    auto planes = std::make_shared<ObservedPlanes>();
    for (const Face& face : faces) {
      for (const auto& [from, to] : visibleRuns(face, T_world_base.translation().head<2>())) {
        planes->push_back(observed(face, from, to, T_world_base, generator));
      }
    }
    return planes;
  }

 private:
  static constexpr double kStep_m = 0.1;

  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }

  bool isHidden(const Eigen::Vector2d& eye, const Eigen::Vector2d& point) const {
    for (const Face& face : faces) {
      const Eigen::Vector2d ray = point - eye;
      const Eigen::Vector2d line = face.b - face.a;
      const double det = cross(ray, line);
      if (std::abs(det) < 1e-12) continue;
      const double t = cross(face.a - eye, line) / det;
      const double s = cross(face.a - eye, ray) / det;
      if (t > 1e-6 && t < 1.0 - 1e-3 && s > 0.0 && s < 1.0 && !face.isDoor(s * face.length())) {
        return true;
      }
    }
    return false;
  }

  std::vector<std::pair<double, double>> visibleRuns(const Face& face,
                                                     const Eigen::Vector2d& eye) const {
    std::vector<std::pair<double, double>> runs;
    if (face.normal().dot(eye - face.a) < 0.2) return runs;
    constexpr double kMaxGap_m = 1.4;
    for (double s = 0.5 * kStep_m; s < face.length(); s += kStep_m) {
      const Eigen::Vector2d point = face.a + s * face.along();
      if ((point - eye).norm() > range_m || face.isDoor(s) || isHidden(eye, point)) continue;
      if (runs.empty() || s - runs.back().second > kMaxGap_m) {
        runs.emplace_back(s - 0.5 * kStep_m, s);
      }
      runs.back().second = s + 0.5 * kStep_m;
    }
    std::vector<std::pair<double, double>> long_enough;
    for (const auto& run : runs) {
      if (run.second - run.first > 0.45) long_enough.push_back(run);
    }
    return long_enough;
  }

  ObservedPlane observed(const Face& face, double from, double to, const Pose& T_world_base,
                         std::mt19937* generator) const {
    const Pose T_base_world = T_world_base.inverse();
    const auto corner = [&](double s, double z) {
      const Eigen::Vector2d p = face.a + s * face.along();
      return Eigen::Vector3d(p.x(), p.y(), face.bottom_m + z);
    };
    // Left and right as seen from the front: along the way from a is to the left.
    const auto rectangle = [&](double s0, double s1, double top) {
      return Outline3{T_base_world * corner(s1, 0.0), T_base_world * corner(s0, 0.0),
                      T_base_world * corner(s0, top), T_base_world * corner(s1, top)};
    };
    ObservedPlane plane;
    plane.extent_base.outline = rectangle(from, to, face.height_m);
    plane.area_m2 = (to - from) * face.height_m;
    constexpr double kDoorTop_m = 2.1;
    for (const auto& door : face.doors) {
      if (door.first < from || door.second > to) continue;
      plane.extent_base.holes.push_back(rectangle(door.first, door.second, kDoorTop_m));
      plane.area_m2 -= (door.second - door.first) * kDoorTop_m;
    }
    plane.centroid_base = T_base_world * corner(0.5 * (from + to), 0.5 * face.height_m);
    const Plane truth_base = T_base_world * face.plane();

    std::normal_distribution<double> normal;
    const Eigen::Vector3d sigma(noise.sigma_rad, noise.sigma_rad, noise.sigma_m);
    const Eigen::Vector3d error = sigma.cwiseProduct(
        Eigen::Vector3d(normal(*generator), normal(*generator), normal(*generator)));
    const Eigen::Matrix3d J = tangentFromPoint(truth_base, plane.centroid_base);
    plane.plane_base = retract(truth_base, J * error);
    plane.covariance = J * sigma.cwiseAbs2().asDiagonal() * J.transpose();
    plane.points = 1000;
    return plane;
  }
};

/// Six rooms on both sides of a corridor, 15 m x 9 m. As long as walls are told by their lines and
/// gaps of 1.5 m there are 16 walls in it: four outer ones, both faces of the two along the
/// corridor, and both faces of four between the rooms, which the corridor parts. Six are pairs.
inline PlaneWorld sixRooms() {
  PlaneWorld world;
  const std::vector<std::pair<double, double>> doors{{2.0, 2.9}, {7.0, 7.9}, {12.0, 12.9}};
  world.addWall({0.0, 0.0}, {15.0, 0.0});
  world.addWall({15.0, 0.0}, {15.0, 9.0});
  world.addWall({15.0, 9.0}, {0.0, 9.0});
  world.addWall({0.0, 9.0}, {0.0, 0.0});
  world.addWall({0.0, 4.0}, {15.0, 4.0}, doors);
  world.addWall({0.0, 6.0}, {15.0, 6.0}, doors);
  for (const double x : {5.0, 10.0}) {
    world.addWall({x, 0.0}, {x, 4.0});
    world.addWall({x, 6.0}, {x, 9.0});
  }
  return world;
}
constexpr int kWallsOfSixRooms = 16;
constexpr int kPairsOfSixRooms = 6;

/// In and out of all six rooms, a pose every metre, looking along the way.
inline std::vector<Pose> walkThroughSixRooms() {
  std::vector<Eigen::Vector2d> way{{2.45, 2.0}};
  for (const double x : {2.45, 7.45, 12.45}) {
    for (const auto& [door_y, room_y] : {std::pair{3.5, 2.0}, std::pair{6.5, 7.5}}) {
      way.emplace_back(x, 5.0);
      way.emplace_back(x, door_y);
      way.emplace_back(x - 1.5, room_y);
      way.emplace_back(x + 1.5, room_y);
      way.emplace_back(x, door_y);
    }
    way.emplace_back(x, 5.0);
  }
  way.emplace_back(1.0, 5.0);
  std::vector<Pose> poses;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) {
    const Eigen::Vector2d step = way[k + 1] - way[k];
    const int count = std::max(1, static_cast<int>(std::round(step.norm())));
    for (int n = 0; n < count; ++n) {
      Pose T = Pose::Identity();
      T.translation() << way[k] + step * n / count, 0.8;
      T.linear() = expSO3({0.0, 0.0, std::atan2(step.y(), step.x())});
      poses.push_back(T);
    }
  }
  return poses;
}

}  // namespace mrpt_sgraphs::test
