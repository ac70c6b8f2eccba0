// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// "odometry between keyframe 3 and keyframe 4"
std::string describe(const Factor& factor);

/// @param values  Of its nodes, as for Factor::linearize.
/// @throws std::invalid_argument naming the nodes, if one of them is there twice, or if the
/// factor's
///         cost, gradient and Hessian at `values` are not those of a finite measurement with a
///         positive semidefinite information.
void requireSound(const Factor& factor, const VariableView* values);

}  // namespace mrpt_sgraphs
