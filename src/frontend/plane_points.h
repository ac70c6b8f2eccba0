// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/scan_gatherer.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "plane_growing.h"

namespace mrpt_sgraphs {

/// Points on one side of a plane, in a frame that lies nearly in it.
struct PlanePoints {
  PlaneFrame frame;      ///< Its normal points to the side that they were seen from.
  double sigma_m = 0.0;  ///< Of the points across the plane.
  std::vector<int> indices;            ///< Into the cloud.
  std::vector<Eigen::Vector3f> local;  ///< Along u, v and the normal, from the frame's origin.
};

/// Gives the points to the regions that they lie on, each to one: those in cells of two surfaces,
/// which no region took, and those of the two faces of a thin wall by the side that they were seen
/// from.
std::vector<PlanePoints> pointsOnPlanes(const GatheredPoints& points, const PlaneCells& cells,
                                        const std::vector<PlaneRegion>& regions);

/// A plane and how well its points determine it.
struct MeasuredPlane {
  Plane plane;
  Eigen::Vector3d centroid{0.0, 0.0, 0.0};
  /// Of the PlaneTangent's turns and of the offset *at the centroid*, from how the points lie about
  /// the plane: each tells what it scatters by itself, so noise along slanting beams is no
  /// assumption.
  Eigen::Matrix3d covariance_at_centroid = Eigen::Matrix3d::Identity();
  double sigma_m = 0.0;
  Eigen::Vector2d spread_m{0.0, 0.0};  ///< One sigma of where the points are, along u and v.
};

/// Fits a plane to the points, and drops those that do not lie on it.
/// @param on_plane  Four points or more.
MeasuredPlane measurePlane(PlanePoints* on_plane);

/// Whether the points follow a bend about their plane.
bool isBent(const PlanePoints& on_plane, const MeasuredPlane& measured);

}  // namespace mrpt_sgraphs
