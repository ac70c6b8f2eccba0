// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "mrpt_sgraphs/frontend/scan_gatherer.h"
#include "mrpt_sgraphs/geometry/pose.h"

/// A few rectangles and pillars, seen by a LiDAR of any pattern: what the segmentation is tried on.
namespace mrpt_sgraphs::test {

/// From `corner` along two edges that are orthogonal to each other.
struct Rectangle {
  Eigen::Vector3d corner;
  Eigen::Vector3d edge_u;
  Eigen::Vector3d edge_v;

  std::optional<double> hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d normal = edge_u.cross(edge_v);
    const double slope = normal.dot(direction);
    if (std::abs(slope) < 1e-9) return std::nullopt;
    const double range_m = normal.dot(corner - from) / slope;
    const Eigen::Vector3d at = from + range_m * direction - corner;
    const double u = at.dot(edge_u) / edge_u.squaredNorm();
    const double v = at.dot(edge_v) / edge_v.squaredNorm();
    if (range_m <= 0.0 || u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) return std::nullopt;
    return range_m;
  }
};

/// Upright, of any height.
struct Pillar {
  Eigen::Vector2d centre;
  double radius_m;

  std::optional<double> hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    const Eigen::Vector2d o = from.head<2>() - centre;
    const Eigen::Vector2d d = direction.head<2>();
    const double a = d.squaredNorm();
    const double b = o.dot(d);
    const double inside = b * b - a * (o.squaredNorm() - radius_m * radius_m);
    if (a < 1e-12 || inside < 0.0) return std::nullopt;
    const double range_m = (-b - std::sqrt(inside)) / a;
    if (range_m <= 0.0) return std::nullopt;
    return range_m;
  }
};

struct FlatWorld {
  std::vector<Rectangle> rectangles;
  std::vector<Pillar> pillars;

  /// Walls of a room, its floor and its ceiling; x_min, y_min, z_min to x_max, y_max, z_max.
  static FlatWorld box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const Eigen::Vector3d size = high - low;
    const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    return {{{low, x, z}, {low, y, z}, {low + y, x, z}, {low + x, y, z}, {low, x, y},
             {low + z, x, y}},
            {}};
  }

  std::optional<double> hit(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Rectangle& r : rectangles) {
      nearest_m = std::min(nearest_m, r.hit(from, direction).value_or(nearest_m));
    }
    for (const Pillar& p : pillars) {
      nearest_m = std::min(nearest_m, p.hit(from, direction).value_or(nearest_m));
    }
    if (!std::isfinite(nearest_m)) return std::nullopt;
    return nearest_m;
  }
};

/// Directions of one scan, unit vectors in the sensor's frame, and the beams that they belong to.
struct Pattern {
  std::vector<Eigen::Vector3d> directions;
  std::vector<std::uint16_t> rings;

  /// @param lowest_rad, highest_rad  Elevations of the outermost beams.
  static Pattern spinning(int rings, int columns, double lowest_rad, double highest_rad) {
    Pattern pattern;
    for (int column = 0; column < columns; ++column) {
      const double azimuth = 2.0 * M_PI * column / columns;
      for (int ring = 0; ring < rings; ++ring) {
        const double elevation = lowest_rad + (highest_rad - lowest_rad) * ring / (rings - 1);
        pattern.directions.emplace_back(std::cos(elevation) * std::cos(azimuth),
                                        std::cos(elevation) * std::sin(azimuth),
                                        std::sin(elevation));
        pattern.rings.push_back(static_cast<std::uint16_t>(ring));
      }
    }
    return pattern;
  }

  /// A rosette within a cone about x, as solid-state sensors draw it; without rings.
  static Pattern rosette(int points, double half_angle_rad) {
    Pattern pattern;
    for (int k = 0; k < points; ++k) {
      const double t = 2.0 * M_PI * k * 0.00137;
      const double off = half_angle_rad * std::abs(std::sin(7.31 * t));
      const double around = 3.17 * t;
      pattern.directions.emplace_back(std::cos(off), std::sin(off) * std::cos(around),
                                      std::sin(off) * std::sin(around));
      pattern.rings.push_back(0);
    }
    return pattern;
  }
};

/// One scan from a pose, given in the sensor's own frame.
inline Cloud scanOf(const FlatWorld& world, const Pattern& pattern, const Pose& T_world_sensor,
                    double noise_m, std::mt19937* random) {
  std::normal_distribution<double> noise(0.0, noise_m);
  Cloud cloud;
  for (std::size_t k = 0; k < pattern.directions.size(); ++k) {
    const auto range_m = world.hit(T_world_sensor.translation(),
                                   T_world_sensor.linear() * pattern.directions[k]);
    if (!range_m) continue;
    Point point;
    point.getVector3fMap() =
        ((*range_m + noise(*random)) * pattern.directions[k]).cast<float>();
    point.data[3] = 1.0F;
    point.ring = pattern.rings[k];
    cloud.push_back(point);
  }
  return cloud;
}

}  // namespace mrpt_sgraphs::test
