// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

using Triangle2 = std::array<Eigen::Vector2d, 3>;
using Triangle3 = std::array<Eigen::Vector3d, 3>;

/// Triangles that cover what an extent contains, once, and nothing else; counter-clockwise, none of
/// them flat.
///
/// Any rings will do. An outline that was straightened can cut into a hole that stands on it, and
/// holes can touch each other; cutting ears off, which takes fewer triangles, needs rings without
/// either. So the extent is cut along v wherever a ring has a corner or rings cross, into
/// trapezoids.
std::vector<Triangle2> triangulated(const FlatExtent& extent);

/// The same for an extent on a plane: counter-clockwise as seen from the normal's side.
std::vector<Triangle3> triangulated(const PlanarExtent& extent, const Plane& plane);

}  // namespace mrpt_sgraphs
