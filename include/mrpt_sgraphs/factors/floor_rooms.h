// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/plane_observation.h"

namespace mrpt_sgraphs {

/// A room stands on its floor: its origin on the floor's plane, its z along the plane's normal. The
/// floor (n, d), seen from T_map_room = (R, c), is compared with the plane z = 0:
///
///     e = [ x and y of R' n ]   2 rows, rad for small angles      e in R^3
///         [ d - n . c       ]   1 row,  m
///
/// Frames: the floor and T_map_room in `map`.
class FloorRoomFactor final : public ResidualFactor<3, Plane, Pose> {
 public:
  /// @param information  Inverse covariance of e: symmetric, 1/rad^2, 1/(rad m), 1/m^2.
  FloorRoomFactor(FloorId floor, RoomId room, const Information& information,
                  const RobustKernel& kernel = {})
      : ResidualFactor({floor, room}, information, kernel) {}

  const char* type() const override { return "floor_room"; }

  Residual evaluate(const Plane& floor_map, const Pose& T_map_room, Jacobian<Plane>* J_floor,
                    Jacobian<Pose>* J_room) const override {
    return planeResidual(Plane{}, tangentBasis(Plane{}.normal), T_map_room, floor_map, J_room,
                         J_floor);
  }
};

}  // namespace mrpt_sgraphs
