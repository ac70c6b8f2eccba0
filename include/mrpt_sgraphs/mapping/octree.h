// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <octomap/OcTree.h>

#include <memory>

#include "mrpt_sgraphs/mapping/occupancy_map.h"

namespace mrpt_sgraphs {

/// The map as an OctoMap that is fit to be sent or written: each voxel occupied, free or not there,
/// and eight equal ones joined.
std::unique_ptr<octomap::OcTree> octreeOf(const OccupancyMap& map);

}  // namespace mrpt_sgraphs
