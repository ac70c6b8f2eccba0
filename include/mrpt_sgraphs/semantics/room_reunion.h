// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A room of which the map may have two: where the newest keyframe is if the room that it is in is
/// one that the robot was in before.
struct RoomReunion {
  RoomId older;
  RoomId younger;
  KeyframeId keyframe;  ///< Of the older room, the nearest to the newest one then.
  Pose T_keyframe_newest = Pose::Identity();
};

/// Looks for an older room of the same shape on the same floor, as far away as the drift may be,
/// whose doorways are where those of the newest keyframe's room are. Two rooms that open into a
/// third one at different places are two; where more than one older room fits, it is none.
/// Rooms that look the same on the same kind of corridor are not told apart by all that: what is
/// found is a guess for the scans to verify.
/// @param max_chi2  Gate on the drift, 6 degrees of freedom.
std::optional<RoomReunion> findReunion(const GraphSnapshot& graph, double max_chi2);

}  // namespace mrpt_sgraphs
