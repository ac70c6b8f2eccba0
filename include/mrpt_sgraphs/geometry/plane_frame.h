// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/geometry/observed_plane.h"
#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

/// Corners in order in a plane's own coordinates [m], the last joins the first.
using Outline2 = std::vector<Eigen::Vector2d>;

/// A PlanarExtent in the coordinates of a PlaneFrame.
struct FlatExtent {
  Outline2 outline;
  std::vector<Outline2> holes;
};

/// Coordinates in a plane: u lies level and v points as far up as it can, so that u x v is the
/// normal. On a plane that lies level itself, u is any direction.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();

  PlaneFrame() = default;

  /// @param near  Its foot on the plane is the origin. To be chosen near what is described: where
  ///              the origin is far, a small turn of the plane is a large shift along it.
  PlaneFrame(const Plane& plane, const Eigen::Vector3d& near)
      : origin(near - (plane.normal.dot(near) - plane.distance) * plane.normal),
        normal(plane.normal) {
    constexpr double kLevel = 0.05;  // sine of the normal's angle to the vertical: about 3 degrees
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(normal);
    u = level.norm() > kLevel ? level.normalized() : Eigen::Vector3d(tangentBasis(normal).col(0));
    v = normal.cross(u);
  }

  /// To the frame's axes: u, v and the normal as rows.
  Eigen::Matrix3d rotation() const {
    Eigen::Matrix3d R;
    R << u.transpose(), v.transpose(), normal.transpose();
    return R;
  }

  Eigen::Vector2d flat(const Eigen::Vector3d& point) const {
    return {u.dot(point - origin), v.dot(point - origin)};
  }
  Eigen::Vector3d lifted(const Eigen::Vector2d& point) const {
    return origin + point.x() * u + point.y() * v;
  }
};

/// Whether the point lies within the outline and in none of the holes, whichever way round they go.
bool contains(const FlatExtent& extent, const Eigen::Vector2d& point);

/// The foot of an extent on the frame's plane, and back.
FlatExtent flattened(const PlanarExtent& extent, const PlaneFrame& frame);
PlanarExtent lifted(const FlatExtent& extent, const PlaneFrame& frame);

}  // namespace mrpt_sgraphs
