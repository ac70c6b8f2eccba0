// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/polygon2d.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_sgraphs::sim {
namespace {

/// True if the closed segments ab and cd share a point.
bool segmentsMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
  constexpr double kTouching_m = 1e-9;
  return distanceToSegment(c, a, b) < kTouching_m || distanceToSegment(d, a, b) < kTouching_m ||
         distanceToSegment(a, c, d) < kTouching_m || distanceToSegment(b, c, d) < kTouching_m;
}

}  // namespace

double signedArea(const Polygon2& polygon) {
  double twice = 0.0;
  for (size_t k = 0; k < polygon.size(); ++k) twice += cross(polygon[k], nextCorner(polygon, k));
  return 0.5 * twice;
}

bool contains(const Polygon2& polygon, const Eigen::Vector2d& point) {
  bool inside = false;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& a = polygon[k];
    const Eigen::Vector2d& b = nextCorner(polygon, k);
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - s * along).norm();
}

double distanceToOutline(const Polygon2& polygon, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < polygon.size(); ++k) {
    nearest = std::min(nearest, distanceToSegment(point, polygon[k], nextCorner(polygon, k)));
  }
  return nearest;
}

bool isSimple(const Polygon2& polygon) {
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours share their corner
      if (segmentsMeet(polygon[i], nextCorner(polygon, i), polygon[j], nextCorner(polygon, j))) {
        return false;
      }
    }
  }
  return true;
}

double gapBetween(const Polygon2& p, const Polygon2& q) {
  if (contains(p, q.front()) || contains(q, p.front())) return 0.0;
  double gap = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < p.size(); ++i) {
    for (size_t j = 0; j < q.size(); ++j) {
      if (segmentsMeet(p[i], nextCorner(p, i), q[j], nextCorner(q, j))) return 0.0;
    }
    gap = std::min(gap, distanceToOutline(q, p[i]));
  }
  for (const Eigen::Vector2d& corner : q) gap = std::min(gap, distanceToOutline(p, corner));
  return gap;
}

Polygon2 rectangle(const Eigen::Vector2d& centre, const Eigen::Vector2d& size, double yaw_rad) {
  const Eigen::Vector2d u = 0.5 * size.x() * direction(yaw_rad);
  const Eigen::Vector2d v = 0.5 * size.y() * leftOf(direction(yaw_rad));
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

}  // namespace mrpt_sgraphs::sim
