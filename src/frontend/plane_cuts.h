// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "plane_points.h"

namespace mrpt_sgraphs {

/// A plane among the others of its scan.
struct PlaneCandidate {
  PlanePoints points;
  MeasuredPlane measured;
};

/// The line in which another plane crosses, in a plane's frame: points are in front of the other
/// where `side` is positive [m].
struct Crossing {
  Eigen::Vector2f normal;
  float distance = 0.0F;

  float side(const Eigen::Vector2f& local) const { return normal.dot(local) - distance; }
};

/// Nothing for planes that are nearly parallel.
std::optional<Crossing> crossingOf(const PlaneFrame& frame, const Plane& other);

/// Cuts planes where a wall crosses them. The walls of neighbouring rooms often lie in one line, and
/// through open doors one sees several; only the wall between the rooms, which is thinner than most
/// gaps, tells them apart. Nothing is cut that goes on behind what meets it, as the wall above a
/// cabinet does.
///
/// @param min_points  Pieces with fewer are dropped.
void cutAtCrossings(int min_points, std::vector<PlaneCandidate>* planes);

}  // namespace mrpt_sgraphs
