// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What rooms do in the graph.
struct RoomLayerConfig {
  bool factors = true;           ///< Whether rooms tie their walls to each other.
  bool close_loops = true;       ///< Where the robot is in a room that the map has twice.
  double max_angle_rad = 0.035;  ///< Walls that are farther from a right angle have none.
  /// How exact a building is, its walls tell; none is taken for more exact than this.
  double least_right_angle_sigma_rad = 0.0002;  ///< Of walls from right angles in their room,
  double least_upright_sigma_rad = 0.0002;      ///< from upright in their room,
  double least_floor_sigma_rad = 0.0005;        ///< and of rooms from upright on their floor.
  double kernel_chi2 = 6.0;                     ///< Walls with a larger chi2 lose weight
                                                ///< (2 dof, 5 %).

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("factors", self.factors);
    field("close_loops", self.close_loops);
    field("max_angle_rad", self.max_angle_rad, 0.001, 0.3);
    field("least_right_angle_sigma_rad", self.least_right_angle_sigma_rad, 1e-5, 0.1);
    field("least_upright_sigma_rad", self.least_upright_sigma_rad, 1e-5, 0.1);
    field("least_floor_sigma_rad", self.least_floor_sigma_rad, 1e-5, 0.1);
    field("kernel_chi2", self.kernel_chi2, 0.1, 1e6);
  }
};

}  // namespace mrpt_sgraphs
