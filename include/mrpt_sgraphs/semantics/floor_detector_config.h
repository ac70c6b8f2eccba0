// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What belongs to which level of a building.
struct FloorDetectorConfig {
  bool enabled = true;
  double max_off_m = 0.15;      ///< A keyframe that is farther from its usual height above ground
                                ///< does not stand on it,
  double climb_off_m = 0.05;    ///< ... and one on the way to such a keyframe by this much neither.
  double same_height_m = 0.05;  ///< Levels that are as high as each other within this
  double same_angle_rad = 0.01;  ///< ... and as parallel are one.
  double stairs_apart_m = 3.0;   ///< Ways between two levels that come no nearer are two stairs.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
    field("max_off_m", self.max_off_m, 0.01, 10.0);
    field("climb_off_m", self.climb_off_m, 0.001, 10.0);
    field("same_height_m", self.same_height_m, 0.0, 10.0);
    field("same_angle_rad", self.same_angle_rad, 0.0, 0.8);
    field("stairs_apart_m", self.stairs_apart_m, 0.0, 1000.0);
  }
};

}  // namespace mrpt_sgraphs
