// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "factor_check.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs {
namespace {

/// Of the largest entry: what rounding makes of an eigenvalue of zero is smaller.
constexpr double kMaxNegativeEigenvalue = 1e-8;

void require(bool holds, const Factor& factor, const char* problem) {
  if (!holds) throw std::invalid_argument(describe(factor) + ": " + problem);
}

}  // namespace

std::string describe(const Factor& factor) {
  std::string text = factor.type();
  for (int k = 0; k < factor.nodeCount(); ++k) {
    text += (k == 0 ? " between " : k + 1 == factor.nodeCount() ? " and " : ", ");
    text += nameOf(factor.node(k));
  }
  return text;
}

void requireSound(const Factor& factor, const VariableView* values) {
  for (int a = 0; a < factor.nodeCount(); ++a) {
    for (int b = 0; b < a; ++b) {
      require(factor.node(a) != factor.node(b), factor, "a node is there twice");
    }
  }
  if (const auto* relative = dynamic_cast<const RelativePoseFactor*>(&factor)) {
    const Matrix6& information = relative->information();
    constexpr double kMaxAsymmetry = 1e-6;
    require((information - information.transpose()).norm() <= kMaxAsymmetry * information.norm(),
            factor, "the information is not symmetric, or not finite");
  }

  const int rows = factor.tangentRows();
  Eigen::MatrixXd H(rows, rows);
  Eigen::VectorXd g(rows);
  const double cost = factor.linearize(values, H.data(), g.data());
  H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
  require(std::isfinite(cost) && g.allFinite() && H.allFinite(), factor,
          "measurement or information are not finite");
  // not by the pivots of H itself: behind the first that is zero they are made of rounding alone
  const double shift = kMaxNegativeEigenvalue * H.diagonal().cwiseAbs().maxCoeff();
  if (shift > 0.0) {
    H.diagonal().array() += shift;
    require(H.llt().info() == Eigen::Success, factor,
            "the information is not positive semidefinite");
  } else {
    require(H.isZero(0.0), factor, "the information is not positive semidefinite");
  }
}

}  // namespace mrpt_sgraphs
