// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Whether a symmetric matrix can be an information. A file of few digits may have moved eigenvalues
/// that were zero: so much below zero is still semidefinite.
inline bool isPositiveSemidefinite(const Matrix6& information) {
  if (information.llt().info() == Eigen::Success) return true;
  const Tangent eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix6>(information, Eigen::EigenvaluesOnly).eigenvalues();
  constexpr double kRounding = 1e-9;
  return eigenvalues.minCoeff() >= -kRounding * eigenvalues.cwiseAbs().maxCoeff();
}

}  // namespace mrpt_sgraphs
