// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <octomap/OcTree.h>
#include <octomap_msgs/Octomap.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "mrpt_sgraphs/mapping/floor_grid.h"
#include "mrpt_sgraphs/mapping/occupancy_map.h"

namespace mrpt_sgraphs {

/// The header is left to be filled in, as in those below.
/// @throws std::runtime_error if OctoMap cannot write it.
octomap_msgs::Octomap toMsg(const octomap::OcTree& tree);

/// Fit for move_base: along the axes of `map`, z where the ground is.
nav_msgs::OccupancyGrid toMsg(const FloorGrid& grid);

using VoxelCloud = pcl::PointCloud<pcl::PointXYZ>;

/// The centres of the occupied voxels.
VoxelCloud::Ptr occupiedCentres(const OccupancyMap& map);

}  // namespace mrpt_sgraphs
