// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace mrpt_sgraphs {

/// What rooms do in the graph.
struct RoomLayerConfig {
  bool factors = true;                   ///< Whether rooms tie their walls to each other.
  double max_angle_rad = 0.035;          ///< Walls that are farther from a right angle have none.
  double right_angle_sigma_rad = 0.002;  ///< How far walls are from right angles,
  double upright_sigma_rad = 0.002;      ///< and from upright in their room.
  double floor_sigma_rad = 0.005;        ///< How far rooms are from upright on their floor.
  double kernel_chi2 = 6.0;              ///< Walls with a larger chi2 lose weight (2 dof, 5 %).

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("factors", self.factors);
    field("max_angle_rad", self.max_angle_rad, 0.001, 0.3);
    field("right_angle_sigma_rad", self.right_angle_sigma_rad, 1e-5, 1.0);
    field("upright_sigma_rad", self.upright_sigma_rad, 1e-5, 1.0);
    field("floor_sigma_rad", self.floor_sigma_rad, 1e-5, 1.0);
    field("kernel_chi2", self.kernel_chi2, 0.1, 1e6);
  }
};

}  // namespace mrpt_sgraphs
