// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

/// Corners in order, the last joins the first; all in one plane.
using Outline3 = std::vector<Eigen::Vector3d>;

/// How far a surface was seen: an outline, concave where the surface is, and what is open in it.
struct PlanarExtent {
  Outline3 outline;  ///< Counter-clockwise as seen from the side that the normal points to.
  std::vector<Outline3> holes;
};

/// An extent of which every corner is what `map` makes of it.
template <typename Map>
PlanarExtent mapped(PlanarExtent extent, const Map& map) {
  for (Eigen::Vector3d& corner : extent.outline) corner = map(corner);
  for (Outline3& hole : extent.holes) {
    for (Eigen::Vector3d& corner : hole) corner = map(corner);
  }
  return extent;
}

/// extent_a = T_a_b * extent_b, as for points.
inline PlanarExtent operator*(const Pose& T_a_b, const PlanarExtent& extent_b) {
  return mapped(extent_b, [&T_a_b](const Eigen::Vector3d& corner) -> Eigen::Vector3d {
    return T_a_b * corner;
  });
}

/// A flat surface as it was seen from one place.
struct ObservedPlane {
  Plane plane_base;
  /// Of the PlaneTangent at plane_base, [rad^2, rad m; rad m, m^2]: full, since the angle's error
  /// and the distance's go together wherever the surface is far from the base's origin.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centroid_base = Eigen::Vector3d::Zero();  ///< Of its points [m].
  PlanarExtent extent_base;
  double area_m2 = 0.0;  ///< Of the extent without its holes.
  int points = 0;
};

/// Whether it can be reasoned with: a plane, a covariance that is one, everything finite.
bool isSound(const ObservedPlane& plane);

using ObservedPlanes = std::vector<ObservedPlane>;
using ObservedPlanesConstPtr = std::shared_ptr<const ObservedPlanes>;

}  // namespace mrpt_sgraphs
