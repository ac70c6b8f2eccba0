// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/building.h"
#include "sim/shapes.h"

namespace mrpt_sgraphs::sim {

/// How much of each wall face the lidar saw from near: what a map of walls can be asked for.
///
/// A face is divided into squares of kCell_m from its lower corner on, those at its far and upper
/// end cut off by it. A square is seen when a ray that the lidar had an echo of ended in it, on the
/// face itself and not on a jamb, a pane or what stands before the wall, after at most kNear_m.
class SeenWalls {
 public:
  static constexpr double kCell_m = 0.2;
  static constexpr double kNear_m = 10.0;

  explicit SeenWalls(const Building& building);

  /// An echo of the ray from what it hit, wall or not.
  void add(const Ray& ray_map, const Hit& hit);

  /// @param face  Its index in wallFaces, the wall's id.
  double area_m2(size_t face) const;

 private:
  struct Face {
    Eigen::Vector3d corner_map;  ///< The first on the floor.
    Eigen::Vector2d along;
    double length_m;
    double height_m;
    int columns;
    int rows;
    std::vector<bool> seen;  ///< Row by row.
  };
  std::vector<Face> faces_;
};

}  // namespace mrpt_sgraphs::sim
