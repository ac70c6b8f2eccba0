// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// The maps to use: OctoMap, grids and points.
struct MapConfig {
  double cell_m = 0.1;             ///< Edge of a cell of the OctoMap and of the grids.
  double max_range_m = 15.0;       ///< Rays are followed so far from the sensor.
  int max_rays = 30000;            ///< Of a keyframe: of more, every second, third, ... is taken.
  double min_height_m = 0.15;      ///< Above the ground: what a robot drives over,
  double max_height_m = 1.8;       ///< and what it fits under, is no obstacle in a grid.
  double points_voxel_m = 0.1;     ///< Edge of the voxel that has one point of `map_points`.
  double publish_period_s = 2.0;   ///< The nodelet's maps follow the graph so often.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("cell_m", self.cell_m, 0.02, 1.0);
    field("max_range_m", self.max_range_m, 1.0, 100.0);
    field("max_rays", self.max_rays, 100, 1000000);
    field("min_height_m", self.min_height_m, -2.0, 5.0);
    field("max_height_m", self.max_height_m, 0.1, 20.0);
    field("points_voxel_m", self.points_voxel_m, 0.01, 1.0);
    field("publish_period_s", self.publish_period_s, 0.1, 3600.0);
  }
};

}  // namespace mrpt_sgraphs
