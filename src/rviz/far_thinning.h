// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mrpt_sgraphs {

/// From where a scene is looked at.
struct Eye {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// Of a view without perspective: from as far [m] everything is seen. 0: perspective.
  double parallel_distance_m = 0.0;

  double distanceTo(const Eigen::Vector3d& point) const {
    return parallel_distance_m > 0.0 ? parallel_distance_m : (point - place).norm();
  }
};

/// Of places, which one is shown where each of them is: itself within `near_m` of the eye; beyond,
/// one stands for all in its cell. Cells have edges of `kCellOverDistance` of the distance or less,
/// so that what is gone could hardly have been told from what stands for it.
/// @param near_m  0: all are shown.
/// @return As many as places; each the index of a place that is shown, the first of its cell.
std::vector<std::size_t> thinnedFarAway(const std::vector<Eigen::Vector3d>& places, const Eye& eye,
                                        double near_m);

constexpr double kCellOverDistance = 1.0 / 30.0;

}  // namespace mrpt_sgraphs
