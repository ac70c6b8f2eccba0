// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "plane_cells.h"

namespace mrpt_sgraphs {

/// Cells that lie on one plane and hang together.
struct PlaneRegion {
  FittedPlane fit;
  double sigma_m = 0.0;    ///< Of its points across the plane.
  std::vector<int> cells;  ///< The finest ones; each belongs to one region.
};

/// Grows planes from cells that are flat, the flattest first, and from coarser cells where finer ones
/// have too few points. What is bent is grown too, and left out.
///
/// @param max_thickness_m  One sigma of the points across a plane.
/// @param min_points       A region with fewer is none.
std::vector<PlaneRegion> growPlanes(const PlaneCells& cells, double max_thickness_m,
                                    int min_points);

}  // namespace mrpt_sgraphs
