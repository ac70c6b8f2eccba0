// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/scan_gatherer.h"
#include "plane_growing.h"

namespace mrpt_sgraphs {

/// Points on one side of a plane.
struct PlanePoints {
  FittedPlane fit;   ///< Its normal points to the side that they were seen from.
  double sigma_m = 0.0;
  std::vector<int> indices;
};

/// Gives the points to the regions that they lie on, each to one: those in cells of two surfaces,
/// which no region took, and those of the two faces of a thin wall by the side that they were seen
/// from.
std::vector<PlanePoints> pointsOnPlanes(const GatheredPoints& points, const PlaneCells& cells,
                                        const std::vector<PlaneRegion>& regions);

/// Fits the plane to its points again, and drops those that do not lie on it.
void refit(const Cloud& cloud, PlanePoints* on_plane);

/// Of the plane's tangent *at the points' centroid*, from how the points lie about it: each tells
/// what it scatters by itself, so that noise along slanting beams is no assumption.
Eigen::Matrix3d covarianceAtCentroid(const Cloud& cloud, const PlanePoints& on_plane);

}  // namespace mrpt_sgraphs
