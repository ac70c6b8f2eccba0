// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"

namespace mrpt_sgraphs {

/// How exactly a building is built: standard deviations [rad].
struct RightAngles {
  double right_angle_rad = 0.01;  ///< Of walls from right angles to the room's axes,
  double upright_rad = 0.01;      ///< from standing upright in their room,
  double floor_rad = 0.01;        ///< and of rooms from standing upright on their floor.

  template <typename Archive>
  void archive(Archive& a) {
    a("right_angle_rad", right_angle_rad);
    a("upright_rad", upright_rad);
    a("floor_rad", floor_rad);
  }

  friend bool operator==(const RightAngles& a, const RightAngles& b) {
    return a.right_angle_rad == b.right_angle_rad && a.upright_rad == b.upright_rad &&
           a.floor_rad == b.floor_rad;
  }
};

/// Values that should be the same but for what is measured wrongly and what is built wrongly:
///
///     r = X theta + e,   var e_i = v_i + sigma^2
///
/// The sum over groups, each with unknown theta of its own, tells sigma.
struct ScatterGroup {
  Eigen::VectorXd r;  ///< [rad]
  Eigen::VectorXd v;  ///< As they are known [rad^2].
  Eigen::MatrixXd X;  ///< No columns: nothing is unknown.
};

/// The median of what sigma may be after all groups have been seen, when all its orders of
/// magnitude between least and most are as likely before. Few values say little: it is large then.
/// A value in twenty may be anything within `reach`.
/// @param least_rad  No building is more exact.
/// @return One of a few fixed values, so that it does not change with every new measurement.
double scatterOf(const std::vector<ScatterGroup>& groups, double least_rad, double reach_rad);

/// From the walls as their keyframes see them, the keyframes being where they are: what rooms have
/// made of the walls does not count.
/// @param rooms  Of the graph.
RightAngles rightAnglesOf(const std::vector<DetectedRoom>& rooms, double max_angle_rad,
                          const RightAngles& least, const LayeredGraph& graph);

}  // namespace mrpt_sgraphs
