// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/right_angles.h"
#include "mrpt_sgraphs/semantics/room_layer_config.h"

namespace mrpt_sgraphs {

/// The wall's axis if it stands at a right angle to the room's, then exactly along one of those.
/// @param max_angle_rad  What is farther from it has none.
std::optional<Eigen::Vector3d> rightAngledAxis(const BoundingWall& wall, double max_angle_rad);

/// The factors of a room (room_walls.h) with those of its walls, and its floor, that the graph has:
/// the directions of the walls, the centre between opposite walls, the floor, and from the anchor
/// what all these leave open, no more. Walls at other angles than right ones are upright in it.
///
/// If rooms are to have no factors, a pose from the anchor alone, which says nothing on the rest.
std::vector<FactorConstPtr> roomFactors(RoomId id, const DetectedRoom& room,
                                        const RoomLayerConfig& config, const RightAngles& exactness,
                                        const LayeredGraph& graph);

/// Makes the room's factors those that are wanted. A factor that is there and says the same, but
/// for what the next detection may say otherwise, stays.
/// @return Whether one has come or gone.
bool exchangeFactors(RoomId id, const std::vector<FactorConstPtr>& wanted, LayeredGraph* graph);

}  // namespace mrpt_sgraphs
