// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Whether a finite symmetric matrix can be an information. A file of few digits may have moved eigenvalues
/// that were zero: so much below zero is still semidefinite.
inline bool isPositiveSemidefinite(const Matrix6& information) {
  const double largest = information.cwiseAbs().maxCoeff();
  if (largest == 0.0) return true;
  const Matrix6 scaled = information / largest;  // so that nothing overflows
  if (scaled.llt().info() == Eigen::Success) return true;
  constexpr double kRounding = 1e-9;
  return Eigen::SelfAdjointEigenSolver<Matrix6>(scaled, Eigen::EigenvaluesOnly)
             .eigenvalues()
             .minCoeff() >= -kRounding;
}

}  // namespace mrpt_sgraphs
