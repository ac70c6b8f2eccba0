// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/frontend/ground_layer.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"

namespace mrpt_sgraphs {

/// Brings the graph's floors in line with a detection, which may be older than the graph: what is
/// gone since is passed over, what is new since stays as it is. Levels that are one become the
/// older of them, with all that is on them.
/// @param ground  What has made the floors of this graph.
/// @return Whether factors have come or gone.
bool updateFloors(const FloorDetection& detection, GroundLayer* ground, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
