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

using ObservedPlanes = std::vector<ObservedPlane>;
using ObservedPlanesConstPtr = std::shared_ptr<const ObservedPlanes>;

}  // namespace mrpt_sgraphs
