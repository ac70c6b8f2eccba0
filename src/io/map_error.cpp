// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/map_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

/// An outline around less than this [m^2] is a line.
constexpr double kMinArea_m2 = 1e-6;

/// Twice the area times the unit normal (Newell).
Eigen::Vector3d areaVector(const Outline3& outline) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector3d& next = outline[(k + 1) % outline.size()];
    sum += (outline[k] - outline[0]).cross(next - outline[0]);
  }
  return sum;
}

/// Calls `edge(a, b)` for every edge of every loop.
template <typename Loops, typename Edge>
void forEachEdge(const Loops& loops, Edge&& edge) {
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) edge(loop[k], loop[(k + 1) % loop.size()]);
  }
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * along).norm();
}

double distanceToNearest(const std::vector<FlatSurface>& surfaces, const Eigen::Vector3d& point) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const FlatSurface& surface : surfaces) {
    if (surface.distanceToBox(point) >= nearest_m) continue;
    nearest_m = std::min(nearest_m, surface.distance(point));
  }
  return nearest_m;
}

/// @param distance  Of a point of the map [m].
template <typename Distance>
MapError errorOf(const std::vector<FlatSurface>& surfaces,
                 const std::vector<Eigen::Vector3f>& points_map, const Distance& distance) {
  if (surfaces.empty()) throw std::invalid_argument("there is no surface to measure from");
  const std::size_t stride = points_map.size() / kMaxMapPoints + 1;
  std::vector<double> distances_m;
  for (std::size_t k = 0; k < points_map.size(); k += stride) {
    distances_m.push_back(distance(points_map[k]));
  }
  const auto far = std::count_if(distances_m.begin(), distances_m.end(),
                                 [](double distance_m) { return distance_m > kFar_m; });
  return {points_map.size(), distances_m.size(), quantile(distances_m, 0.5),
          quantile(distances_m, 0.9),
          static_cast<double>(far) / static_cast<double>(distances_m.size())};
}

}  // namespace

FlatSurface::FlatSurface(const Outline3& outline, const std::vector<Outline3>& holes) {
  const Eigen::Vector3d area2 = areaVector(outline);
  if (outline.size() < 3 || area2.norm() < 2.0 * kMinArea_m2) {
    throw std::invalid_argument("an outline of " + std::to_string(outline.size()) +
                                " corners has no area");
  }
  origin_ = outline[0];
  const Eigen::Vector3d normal = area2.normalized();
  const Eigen::Vector3d first = normal.unitOrthogonal();
  rotation_ << first.transpose(), normal.cross(first).transpose(), normal.transpose();

  const auto addLoop = [this](const Outline3& corners) {
    Outline2 loop;
    for (const Eigen::Vector3d& p : corners) loop.push_back((rotation_ * (p - origin_)).head<2>());
    loops_.push_back(loop);
  };
  addLoop(outline);
  for (const Outline3& hole : holes) {
    if (hole.size() < 3) throw std::invalid_argument("a hole has fewer than three corners");
    addLoop(hole);
  }

  box_min_ = box_max_ = origin_;
  for (const Eigen::Vector3d& corner : outline) {
    box_min_ = box_min_.cwiseMin(corner);
    box_max_ = box_max_.cwiseMax(corner);
  }
}

double FlatSurface::distanceToBox(const Eigen::Vector3d& point) const {
  return (point - point.cwiseMax(box_min_).cwiseMin(box_max_)).norm();
}

double FlatSurface::distance(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = rotation_ * (point - origin_);
  const Eigen::Vector2d p = local.head<2>();

  // Even-odd over all loops at once: within the outline and within none of the holes.
  bool inside = false;
  double edge_m = std::numeric_limits<double>::infinity();
  forEachEdge(loops_, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const bool straddles = (a.y() > p.y()) != (b.y() > p.y());
    if (straddles && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
      inside = !inside;
    }
    edge_m = std::min(edge_m, distanceToSegment(p, a, b));
  });
  return inside ? std::abs(local.z()) : std::hypot(local.z(), edge_m);
}

MapError evaluateMap(const std::vector<FlatSurface>& surfaces,
                     const std::vector<Eigen::Vector3f>& points_map, const Pose& T_truth_map) {
  return errorOf(surfaces, points_map, [&](const Eigen::Vector3f& point_map) {
    return distanceToNearest(surfaces, T_truth_map * point_map.cast<double>());
  });
}

MapError evaluateColumns(const std::vector<FlatSurface>& surfaces,
                         const std::vector<Eigen::Vector3f>& feet_map, double height_m,
                         const Pose& T_truth_map) {
  constexpr double kStep_m = 0.2;
  return errorOf(surfaces, feet_map, [&](const Eigen::Vector3f& foot_map) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (double z = kStep_m; z < height_m; z += kStep_m) {  // the ground itself is everywhere
      const Eigen::Vector3d point_map = foot_map.cast<double>() + Eigen::Vector3d(0.0, 0.0, z);
      nearest_m = std::min(nearest_m, distanceToNearest(surfaces, T_truth_map * point_map));
    }
    return nearest_m;
  });
}

}  // namespace mrpt_sgraphs
