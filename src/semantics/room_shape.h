// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/nodes.h"
#include "wall_line.h"

namespace mrpt_sgraphs {

/// An outline as a room: where it lies and what kind it is. Frame: `floor`.
struct RoomShape {
  RoomAttributes::Kind kind = RoomAttributes::Kind::kPolygon;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< Of the box around it, along its heading.
  double heading_rad = 0.0;  ///< Of most of its walls, and of the longer side of the box.
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< Of the box, along and across.
};

RoomShape shapeOf(const FlatExtent& extent);

/// Where a wall's normal points in the room.
Eigen::Vector3d axisOf(const WallLine& wall, const RoomShape& shape);

}  // namespace mrpt_sgraphs
