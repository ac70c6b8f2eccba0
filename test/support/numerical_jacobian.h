// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs::test {

/// Central differences of `residual(T)` over the right perturbation of T, one column a direction.
template <typename Residual>
Matrix6 centralDifferences(const Residual& residual, const Pose& T, double step = 1e-6) {
  Matrix6 jacobian;
  for (int k = 0; k < 6; ++k) {
    const Tangent delta = Tangent::Unit(k) * step;
    jacobian.col(k) = (residual(retract(T, delta)) - residual(retract(T, -delta))) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace mrpt_sgraphs::test
