// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/Floors.h"
#include "mrpt_sgraphs/Rooms.h"
#include "mrpt_sgraphs/SituationalGraph.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"

/// What the detectors of rooms and floors take and give, from and to messages. What comes from a
/// message is sound in itself: every function throws std::invalid_argument, saying in one sentence
/// which part of the message is none and why. Whether its ids are in a graph is not known here.
namespace mrpt_sgraphs {

/// Session and time are left to be filled in.
Rooms toMsg(const RoomDetection& detection, const std::string& map_frame);
Floors toMsg(const FloorDetection& detection, const std::string& map_frame);

RoomDetection toRoomDetection(const Rooms& msg);
FloorDetection toFloorDetection(const Floors& msg);

/// The graph without what is not in its message: factors, and the clouds and planes of keyframes.
GraphSnapshot toSnapshot(const SituationalGraph& msg);

}  // namespace mrpt_sgraphs
