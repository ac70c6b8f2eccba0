// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/point_cloud.h"

namespace mrpt_sgraphs {

/// The indices of the first point in every voxel of the given edge [m], in the cloud's order.
std::vector<int> firstInVoxels(const Cloud& cloud, double voxel_size_m);

/// The cloud with one point a voxel; header and sensor origin are kept.
Cloud::Ptr thinned(const Cloud& cloud, double voxel_size_m);

}  // namespace mrpt_sgraphs
