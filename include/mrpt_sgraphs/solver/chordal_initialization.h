// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/solver/problem.h"

namespace mrpt_sgraphs {

/// Values to begin with that need no first guess, from what the relative poses measured.
///
/// Rotations first: over all 3x3 matrices, with T_i_j = (Z, z) measured and w its weights,
///
///     min sum w_r | R_i Z - R_j |^2
///
/// is linear; its solution is projected to rotations (the chordal relaxation; Martinec and Pajdla,
/// CVPR 2007; Carlone et al., ICRA 2015). With the rotations held, the translations are linear too:
///
///     min sum w_t | t_i + R_i z - t_j |^2
///
/// Fixed poses stay as they are; of each connected part that has none, the pose that was added first.
/// Planes follow the pose that is the first to have seen them. What no relative pose reaches stays.
///
/// @return How many poses were placed: 0, and nothing has changed, if the equations have no solution
///         in numbers.
int initializeChordal(Problem* problem);

}  // namespace mrpt_sgraphs
