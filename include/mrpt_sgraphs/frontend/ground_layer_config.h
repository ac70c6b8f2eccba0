// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/plane_covariance.h"

namespace mrpt_sgraphs {

/// Which of the planes that a keyframe sees is the ground that the robot stands on, and of which
/// level.
struct GroundLayerConfig {
  bool enabled = true;
  double max_tilt_rad = 0.05;  ///< A plane that leans by more against the first level is a ramp,
  double max_map_tilt_rad = 0.15;  ///< ... and that one against the map: a start may be tilted.
  double min_area_m2 = 2.0;        ///< A smaller one is a step or a table.
  double max_step_m = 0.3;         ///< Between the robot's usual height above ground and that of a
                                   ///< plane it may stand on.
  double max_offset_m = 1.0;       ///< However uncertain the way, planes that lie farther apart
                                   ///< are not one level.
  double max_chi2 = 16.3;          ///< Gate on being on a level, 3 degrees of freedom (0.1 %).
  int min_sightings = 5;           ///< Keyframes that make a level: a landing has fewer,
  double min_spread_m = 3.0;       ///< ... and they lie nearer to each other. Not asked of the first.
  double forget_after_m = 20.0;    ///< What is none after this way never will be; a usual
                                   ///< height not met for as long is no usual one.
  double kernel_chi2 = 7.8;        ///< Sightings with a larger chi2 lose weight (3 dof, 5 %).
  SigmaFloor floor;                ///< No level is known better: floors are not quite flat.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
    field("max_tilt_rad", self.max_tilt_rad, 0.001, 0.8);
    field("max_map_tilt_rad", self.max_map_tilt_rad, 0.001, 0.8);
    field("min_area_m2", self.min_area_m2, 0.01, 1000.0);
    field("max_step_m", self.max_step_m, 0.01, 10.0);
    field("max_offset_m", self.max_offset_m, 0.01, 10.0);
    field("max_chi2", self.max_chi2, 0.1, 1e6);
    field("min_sightings", self.min_sightings, 1, 1000);
    field("min_spread_m", self.min_spread_m, 0.0, 100.0);
    field("forget_after_m", self.forget_after_m, 0.1, 1e6);
    field("kernel_chi2", self.kernel_chi2, 0.1, 1e6);
    field("sigma_floor_m", self.floor.m, 1e-5, 1.0);
    field("sigma_floor_rad", self.floor.rad, 1e-6, 1.0);
  }
};

}  // namespace mrpt_sgraphs
