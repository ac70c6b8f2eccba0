// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// Which points of the keyframes' clouds are of which wall.
struct WallPointsConfig {
  double max_distance_m = 0.05;  ///< Farther from a wall's plane is something else.
  double resolution_m = 0.1;     ///< One point a voxel and wall; every point for zero or less.
};

using ColouredCloud = pcl::PointCloud<pcl::PointXYZRGB>;

/// The points that lie on the walls, in `map`, in the colours of the walls: of each keyframe those
/// that lie within the extent of a wall that it observes. Where walls meet, a point is of the
/// nearest.
ColouredCloud::Ptr wallPoints(const GraphSnapshot& graph, const WallPointsConfig& config);

}  // namespace mrpt_sgraphs
