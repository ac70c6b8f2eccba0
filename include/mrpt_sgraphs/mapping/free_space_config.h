// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// Which part of a storey the free space is taken from.
struct FreeSpaceConfig {
  double cell_m = 0.1;
  double min_height_m = 0.4;  ///< Above the ground: what is lower is no obstacle to a room,
  double max_height_m = 1.9;  ///< nor what is higher, the lintels of doors too.
  double max_range_m = 15.0;  ///< Rays are followed so far from the sensor.
  int max_rays = 10000;       ///< Of a keyframe: of more, every second, third, ... is taken.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("cell_m", self.cell_m, 0.05, 0.2);
    field("min_height_m", self.min_height_m, -2.0, 5.0);
    field("max_height_m", self.max_height_m, 0.1, 20.0);
    field("max_range_m", self.max_range_m, 1.0, 100.0);
    field("max_rays", self.max_rays, 100, 1000000);
  }
};

}  // namespace mrpt_sgraphs
