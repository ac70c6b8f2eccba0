// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/nodes.h"

namespace mrpt_sgraphs {

/// Where a plan writes the name of a room, and how large.
struct RoomLabel {
  Eigen::Vector2d place_map{0.0, 0.0};  ///< In the room, far from its border.
  double turn_rad = 0.0;                ///< Along the room; read from below or from the right.
  double text_m = 0.5;                  ///< So that the name fits.
};

/// @param room  With an outline.
RoomLabel labelOf(const RoomNode& room);

}  // namespace mrpt_sgraphs
