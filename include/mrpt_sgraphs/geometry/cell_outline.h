// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/cell_set.h"

namespace mrpt_sgraphs {

/// How cells become polygons.
struct CellOutlineConfig {
  double cell_m = 0.1;
  double max_gap_m = 1.5;    ///< The outline runs across narrower gaps, and they become holes:
  double min_hole_m2 = 0.1;  ///< a door that reaches the ground is one. Smaller holes are left out.
};

/// The outline of cells and what is open inside of it, counter-clockwise in u and v all of them.
///
/// One outline, without self-intersections: pieces that are farther apart than a gap are joined by
/// a strip one cell wide. Corners that the outline passes within a cell are left out, so a slanted
/// edge is straight. What stands free inside of a hole is left out.
FlatExtent outlineOf(const CellSet& cells, const CellOutlineConfig& config);

/// The area inside of a ring [m^2], positive if it is counter-clockwise.
double signedArea(const Outline2& ring);

/// Of an extent without its holes [m^2].
double areaOf(const FlatExtent& extent);

}  // namespace mrpt_sgraphs
