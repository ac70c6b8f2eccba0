// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// A relative pose between two places, by their indices.
struct Way {
  std::size_t from = 0;
  std::size_t to = 0;
  Matrix6 covariance = Matrix6::Zero();  ///< Of T_from_to, right perturbation of `to`.
};

/// For every place the covariance of T_place_goal, right perturbation of the goal, added up along the
/// most certain ways. A bound from above: other ways can only add to what is known.
/// @param T_map_places  Where the places are; they only turn covariances.
/// @return None for a place from which no way leads to the goal.
std::vector<std::optional<Matrix6>> certainWays(std::size_t goal, const std::vector<Way>& ways,
                                                const std::vector<Pose>& T_map_places);

}  // namespace mrpt_sgraphs
