// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/plane_covariance.h"

namespace mrpt_sgraphs {

/// When planes of different keyframes are one wall.
struct WallLayerConfig {
  bool enabled = true;
  double max_tilt_rad = 0.1;      ///< A plane that leans by more is no wall.
  double min_area_m2 = 0.3;       ///< Of a plane that may belong to a wall.
  double min_wall_area_m2 = 1.5;  ///< What is smaller in all, or seen by fewer keyframes, stays
  int min_sightings = 3;          ///< ... out of the graph, and
  double forget_after_m = 20.0;   ///< ... is forgotten when not seen on a way this long.
  double max_gap_m = 1.5;         ///< Surfaces in one line that lie farther apart are two walls.
  double max_angle_rad = 0.15;    ///< However uncertain the way, normals that differ by more
  double max_offset_m = 0.3;      ///< ... and planes that lie farther apart are not one.
  double max_chi2 = 16.3;         ///< Gate on two planes being one, 3 degrees of freedom (0.1 %).
  double doubtful_way_m = 0.1;    ///< What was associated over a way known no better is decided
                                  ///< again when a loop is closed.
  double loop_widening = 4.0;     ///< Of that gate, after a loop closure.
  double split_chi2 = 4.0;        ///< Mean chi2 of sightings that may be of two surfaces.
  double kernel_chi2 = 7.8;       ///< Sightings with a larger chi2 lose weight (3 dof, 5 %).
  double pair_min_thickness_m = 0.05;
  double pair_max_thickness_m = 0.6;
  double pair_max_angle_rad = 0.09;  ///< Faces that are less parallel are not of one wall.
  double pair_min_area_m2 = 0.5;     ///< That lies face to face.
  double pair_sigma_m = 0.05;        ///< Of the thickness: it was taken from the graph itself.
  double pair_sigma_rad = 0.009;     ///< Of the faces being parallel.
  double pair_kernel_chi2 = 7.8;     ///< Pairs with a larger chi2 lose weight.
  double cell_m = 0.1;               ///< Edge of the cells that extents are drawn in.
  SigmaFloor floor;                  ///< No wall is known better.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
    field("max_tilt_rad", self.max_tilt_rad, 0.0, 0.8);
    field("min_area_m2", self.min_area_m2, 0.01, 100.0);
    field("min_wall_area_m2", self.min_wall_area_m2, 0.01, 1000.0);
    field("min_sightings", self.min_sightings, 1, 1000);
    field("forget_after_m", self.forget_after_m, 0.1, 1e6);
    field("max_gap_m", self.max_gap_m, 0.1, 100.0);
    field("max_angle_rad", self.max_angle_rad, 0.001, 0.8);
    field("max_offset_m", self.max_offset_m, 0.01, 10.0);
    field("max_chi2", self.max_chi2, 0.1, 1e6);
    field("doubtful_way_m", self.doubtful_way_m, 0.001, 1e3);
    field("loop_widening", self.loop_widening, 1.0, 1e3);
    field("split_chi2", self.split_chi2, 3.0, 1e6);
    field("kernel_chi2", self.kernel_chi2, 0.1, 1e6);
    field("pair_min_thickness_m", self.pair_min_thickness_m, 0.0, 10.0);
    field("pair_max_thickness_m", self.pair_max_thickness_m, 0.0, 10.0);
    field("pair_max_angle_rad", self.pair_max_angle_rad, 0.001, 0.8);
    field("pair_min_area_m2", self.pair_min_area_m2, 0.01, 100.0);
    field("pair_sigma_m", self.pair_sigma_m, 1e-4, 10.0);
    field("pair_sigma_rad", self.pair_sigma_rad, 1e-4, 1.0);
    field("pair_kernel_chi2", self.pair_kernel_chi2, 0.1, 1e6);
    field("cell_m", self.cell_m, 0.02, 1.0);
    field("sigma_floor_m", self.floor.m, 1e-5, 1.0);
    field("sigma_floor_rad", self.floor.rad, 1e-6, 1.0);
  }
};

}  // namespace mrpt_sgraphs
