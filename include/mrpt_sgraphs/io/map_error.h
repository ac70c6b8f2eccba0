// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// A flat piece of a building: a polygon with holes in it.
class FlatSurface {
 public:
  /// @throws std::invalid_argument for an outline without an area, and for a hole of fewer than
  ///         three corners.
  FlatSurface(const Outline3& outline, const std::vector<Outline3>& holes);

  /// Never more than distance(point), and quickly found.
  double distanceToBox(const Eigen::Vector3d& point) const;

  /// To the nearest point of the surface [m].
  double distance(const Eigen::Vector3d& point) const;

 private:
  Eigen::Vector3d origin_;
  Eigen::Matrix3d rotation_;     ///< Rows: two directions in the plane, its normal.
  std::vector<Outline2> loops_;  ///< The outline, then the holes, in the plane.
  Eigen::Vector3d box_min_;
  Eigen::Vector3d box_max_;
};

/// Farther from the building than this there is nothing: a point there is of a wall that is drawn
/// twice, or of what is no part of the building.
constexpr double kFar_m = 0.15;

/// How far the points of a map lie from the building.
struct MapError {
  std::size_t points = 0;       ///< In the map.
  std::size_t points_used = 0;  ///< At most kMaxMapPoints of them, evenly picked.
  double median_m = 0.0;
  double p90_m = 0.0;
  double far_share = 0.0;  ///< Of them that are farther away than kFar_m.
};

/// What a median and a 90 % distance need is far fewer; it keeps the time of a large map bounded.
constexpr std::size_t kMaxMapPoints = 200000;

/// @throws std::invalid_argument if there is no surface.
MapError evaluateMap(const std::vector<FlatSurface>& surfaces,
                     const std::vector<Eigen::Vector3f>& points_map, const Pose& T_truth_map);

/// The same for the columns of a grid, which are as far as their nearest point.
/// @param feet_map   On the ground.
/// @param height_m   Of the columns.
MapError evaluateColumns(const std::vector<FlatSurface>& surfaces,
                         const std::vector<Eigen::Vector3f>& feet_map, double height_m,
                         const Pose& T_truth_map);

}  // namespace mrpt_sgraphs
