// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace mrpt_sgraphs::sim {

/// Corners in order, the last joins the first. A room's outline is counter-clockwise.
using Polygon2 = std::vector<Eigen::Vector2d>;

/// Positive for a counter-clockwise polygon [m^2].
double signedArea(const Polygon2& polygon);

bool contains(const Polygon2& polygon, const Eigen::Vector2d& point);

double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b);

double distanceToOutline(const Polygon2& polygon, const Eigen::Vector2d& point);

/// True if no two edges cross or touch except at the corner that they share.
bool isSimple(const Polygon2& polygon);

/// The shortest way between two polygons that lie apart; 0 if they share a point.
double gapBetween(const Polygon2& p, const Polygon2& q);

/// A rectangle about `centre`, its first side turned by yaw_rad, counter-clockwise.
Polygon2 rectangle(const Eigen::Vector2d& centre, const Eigen::Vector2d& size, double yaw_rad);

/// (cos, sin) of a heading.
inline Eigen::Vector2d direction(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

/// v turned left by a right angle: for an edge of a counter-clockwise outline it points inside.
inline Eigen::Vector2d leftOf(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

inline double cross(const Eigen::Vector2d& v, const Eigen::Vector2d& w) {
  return v.x() * w.y() - v.y() * w.x();
}

/// Edge k runs from corner k to the next.
inline const Eigen::Vector2d& nextCorner(const Polygon2& polygon, size_t k) {
  return polygon[(k + 1) % polygon.size()];
}

}  // namespace mrpt_sgraphs::sim
