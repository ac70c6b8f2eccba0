// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/factor.h"
#include "mrpt_sgraphs/factors/seen_plane.h"

namespace mrpt_sgraphs {

/// A room is T_map_room: its origin in the middle of its ground, x along its heading, z up. Each of
/// its walls belongs to an axis of the room, a horizontal unit vector along the wall's normal,
/// which points into the room: -x, x, -y, y for the walls of a rectangle, -y and y for a corridor
/// along x, for any other polygon the directions found when it was detected. A room has
///
///     one RoomWallFactor a wall             its direction: parallel, perpendicular, vertical
///     one RoomCentreFactor a pair           the centre is midway between opposite walls
///     one FloorRoomFactor                   the ground, the room upright
///     one RelativePoseFactor                what is still open, from a keyframe inside
///
/// The first is what ties the walls to each other. A room of four walls has 4 x 2 rows of it, and
/// the walls do not move them together without the room's three angles, so five remain when the
/// room is eliminated; in a corridor, 2 x 2 rows against two angles leave two. A RoomCentreFactor
/// says nothing on the walls, it only places the room: its row goes with one coordinate of the
/// centre.
///
/// What walls and floor leave open, in a corridor its place along x, is held by a relative pose
/// from a keyframe whose information is zero in all other directions (its residual has the axes of
/// the room): it places the room, and says nothing on the walls either.
///
/// The direction of a wall against its axis in the room:
///
///     e = B(axis)' R' n     2 rows, rad for small angles      e in R^2
///
/// for the wall (n, d) and T_map_room = (R, c). n = -R axis also gives e = 0: the axis has to be
/// that of the wall's normal.
///
/// Frames: T_map_room and the wall in `map`; the axis in the room.
class RoomWallFactor final : public ResidualFactor<2, Pose, Plane> {
 public:
  /// @param axis_room    Where the wall's normal should point; a unit vector.
  /// @param information  Inverse covariance of e: 1/rad^2. How far walls are from right angles.
  RoomWallFactor(RoomId room, WallId wall, const Eigen::Vector3d& axis_room,
                 const Information& information, const RobustKernel& kernel = {})
      : ResidualFactor({room, wall}, information, kernel),
        axis_room(axis_room),
        basis_room_(tangentBasis(axis_room)) {}

  const char* type() const override { return "room_wall"; }

  Residual evaluate(const Pose& T_map_room, const Plane& wall_map, Jacobian<Pose>* J_room,
                    Jacobian<Plane>* J_wall) const override {
    const Plane seen_room = inverseTimes(T_map_room, wall_map);
    if (J_room != nullptr) *J_room = normalByPose(basis_room_, seen_room);
    if (J_wall != nullptr) *J_wall = normalByPlane(basis_room_, T_map_room, wall_map);
    return basis_room_.transpose() * seen_room.normal;
  }

  const Eigen::Vector3d axis_room;

 private:
  TangentBasis basis_room_;
};

/// The centre c of a room is as far from one wall as from the opposite one:
///
///     e = (n_a . c - d_a) - (n_b . c - d_b)     1 row, m
///
/// Frames: T_map_room and the walls in `map`.
class RoomCentreFactor final : public ResidualFactor<1, Pose, Plane, Plane> {
 public:
  /// @param information  Inverse variance of e: 1/m^2.
  RoomCentreFactor(RoomId room, WallId wall_a, WallId wall_b, const Information& information,
                   const RobustKernel& kernel = {})
      : ResidualFactor({room, wall_a, wall_b}, information, kernel) {}

  const char* type() const override { return "room_centre"; }

  Residual evaluate(const Pose& T_map_room, const Plane& a_map, const Plane& b_map,
                    Jacobian<Pose>* J_room, Jacobian<Plane>* J_a,
                    Jacobian<Plane>* J_b) const override {
    const Plane a_room = inverseTimes(T_map_room, a_map);
    const Plane b_room = inverseTimes(T_map_room, b_map);
    if (J_room != nullptr) *J_room = distanceByPose(b_room) - distanceByPose(a_room);
    if (J_a != nullptr) *J_a = -distanceByPlane(T_map_room, a_map);
    if (J_b != nullptr) *J_b = distanceByPlane(T_map_room, b_map);
    return Residual(b_room.distance - a_room.distance);
  }
};

}  // namespace mrpt_sgraphs
