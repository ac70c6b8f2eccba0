// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sim/building.h"
#include "sim/bvh.h"

namespace mrpt_sgraphs::sim {

/// All surfaces of a building: the still ones in a tree, the people apart.
class Scene {
 public:
  explicit Scene(const Building& building);

  /// People keep out of the robot's way, so where they are depends on where it is.
  /// @param robot_map  Where the robot stands [m].
  std::vector<Cylinder> peopleAt(double time_s, const Eigen::Vector3d& robot_map) const;

  /// What the ray meets first, people included.
  std::optional<Hit> cast(const Ray& ray_map, double max_range_m,
                          const std::vector<Cylinder>& people) const;

 private:
  struct Walker {
    Person person;
    double floor_m;
  };

  Bvh still_;
  std::vector<Walker> walkers_;
};

/// The still surfaces: walls with jambs and lintels, floors, ceilings, furniture, pillars, stairs.
std::vector<Shape> stillShapes(const Building& building);

}  // namespace mrpt_sgraphs::sim
