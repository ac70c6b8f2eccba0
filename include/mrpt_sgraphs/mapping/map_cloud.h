// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The clouds of all keyframes that have one at their poses, one point a voxel, in `map`. Every point
/// for a resolution of zero or less.
Cloud::Ptr mapCloud(const GraphSnapshot& graph, double resolution_m);

}  // namespace mrpt_sgraphs
