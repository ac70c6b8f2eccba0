// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/solver/optimizer.h"
#include "normal_equations.h"

namespace mrpt_sgraphs {

/// The parts of the problem that no factor ties to a fixed variable and that know nothing absolute:
/// they may be anywhere. Each is held by its first pose, or plane if it has no pose.
/// @param held  The variables to hold.
std::vector<GaugeFreedom> floatingParts(const Problem& problem, std::vector<int>* held);

/// What the factorization found undetermined beyond them: which nodes move along each free direction.
std::vector<GaugeFreedom> freeDirections(const NormalEquations& equations,
                                         const std::vector<int>& held_tangents,
                                         const Problem& problem);

}  // namespace mrpt_sgraphs
