// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"

namespace mrpt_sgraphs {

/// The part of an outline on the ground that another one covers, from 0 to 1; heights do not count.
double coveredShare(const PlanarExtent& outline, const PlanarExtent& other);

/// Which room of the graph each detected room is; none for a new one. Rooms are the same by the
/// keyframes that are in both and by the ground that they share where the graph is now.
///
/// A room of the graph is the detected one that has most of it. Where several are the same one, the
/// oldest of them is it.
/// @param rooms  Those whose anchors the graph has lost are none.
std::vector<std::optional<RoomId>> matchRooms(const std::vector<DetectedRoom>& rooms,
                                              const LayeredGraph& graph);

/// The same room with its axes turned by quarters, half turns for a corridor, to where they are
/// next to those of the graph's room.
/// @param T_map_room  Of that.
DetectedRoom turnedTo(const Pose& T_map_room, const LayeredGraph& graph, DetectedRoom room);

}  // namespace mrpt_sgraphs
