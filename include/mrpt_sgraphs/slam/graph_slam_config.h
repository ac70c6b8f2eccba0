// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/frontend/ground_layer_config.h"
#include "mrpt_sgraphs/frontend/wall_layer_config.h"
#include "mrpt_sgraphs/hierarchy/hierarchy_config.h"
#include "mrpt_sgraphs/semantics/loop_closer.h"
#include "mrpt_sgraphs/semantics/room_layer_config.h"
#include "mrpt_sgraphs/slam/solver_config.h"

namespace mrpt_sgraphs {

/// The parameters of the back end.
struct GraphSlamConfig {
  LoopCloserConfig loop_closure;
  WallLayerConfig walls;
  GroundLayerConfig ground;
  RoomLayerConfig rooms;
  HierarchyConfig hierarchy;
  SolverConfig solver;
};

}  // namespace mrpt_sgraphs
