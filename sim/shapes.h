// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>
#include <vector>

#include "sim/polygon2d.h"

/// What a ray can meet. All in the map frame, metres.
namespace mrpt_sgraphs::sim {

struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< Of unit length.
};

/// How a surface answers a lidar.
struct Material {
  double reflectivity = 0.5;  ///< Of a ray that falls on it at right angles, 0..1.
  bool returns = true;        ///< False for a window's pane: the ray is gone.
};

constexpr int kNoFace = -1;

struct Hit {
  double range_m = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Towards either side.
  Material material;
  int face = kNoFace;  ///< Of the wall that was met: its index in wallFaces.
};

using Bounds = Eigen::AlignedBox3d;

/// A planar polygon with holes.
class Patch {
 public:
  /// @param u, v  Orthonormal; outline and holes are coordinates along them from `origin`.
  /// @param face  What its hits say.
  Patch(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
        Polygon2 outline, std::vector<Polygon2> holes, const Material& material,
        int face = kNoFace);

  /// Shortens `hit` and returns true if the ray meets the patch before hit.range_m.
  bool intersect(const Ray& ray, Hit& hit) const;
  Bounds bounds() const;

 private:
  Eigen::Vector3d origin_, u_, v_, normal_;
  double distance_m_;
  Polygon2 outline_;
  Eigen::AlignedBox2d extent_;  ///< Of the outline.
  bool rectangular_;            ///< The outline is its extent.
  std::vector<Polygon2> holes_;
  Material material_;
  int face_;
};

/// An upright box turned about the vertical.
class Box {
 public:
  /// @param centre  Of its footprint.
  Box(const Eigen::Vector2d& centre, const Eigen::Vector2d& size_m, double yaw_rad, double bottom_m,
      double top_m, const Material& material);

  bool intersect(const Ray& ray, Hit& hit) const;
  Bounds bounds() const;

 private:
  Eigen::Vector3d centre_, half_size_;
  Eigen::Vector2d x_axis_;
  Material material_;
};

/// An upright cylinder, closed above and below. A ray that starts in it does not meet it.
class Cylinder {
 public:
  Cylinder(const Eigen::Vector2d& centre, double radius_m, double bottom_m, double top_m,
           const Material& material);

  bool intersect(const Ray& ray, Hit& hit) const;
  Bounds bounds() const;

 private:
  Eigen::Vector2d centre_;
  double radius_m_, bottom_m_, top_m_;
  Material material_;
};

using Shape = std::variant<Patch, Box, Cylinder>;

}  // namespace mrpt_sgraphs::sim
