// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/divergence.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

using Matrix = Eigen::MatrixXd;

/// The prior grows so much at a time until rounding leaves both informations positive definite,
constexpr double kMorePrior = 100.0;
/// ... but no further than this: then it is not rounding.
constexpr double kMaxPriorShare = 1e-6;

/// L^-1 R of two lower triangular matrices: lower triangular as well, for a third of the work.
Matrix lowerSolve(const Matrix& L, Matrix R) {
  constexpr Eigen::Index kColumns = 64;
  const Eigen::Index n = L.rows();
  for (Eigen::Index first = 0; first < n; first += kColumns) {
    const Eigen::Index count = std::min(kColumns, n - first);
    auto part = R.block(first, first, n - first, count);
    L.block(first, first, n - first, n - first).triangularView<Eigen::Lower>().solveInPlace(part);
  }
  return R;
}

/// tr(W W') - n - ln det(W W') of a lower triangular W, exact where W is nearly the identity.
double excess(const Matrix& W) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < W.cols(); ++k) {
    const double x = W(k, k) - 1.0;
    sum += x * x + 2.0 * (x - std::log1p(x)) + W.col(k).tail(W.rows() - k - 1).squaredNorm();
  }
  return sum;
}

/// A Gaussian by the Cholesky factor L of its information.
struct Gaussian {
  Matrix L;
  Eigen::VectorXd mean;
  bool is_sound = false;

  Gaussian(const MarginalModel& model, const Eigen::VectorXd& prior) {
    Matrix information = model.H;
    information.diagonal() += prior;
    const Eigen::LLT<Matrix> cholesky(information);
    is_sound = cholesky.info() == Eigen::Success;
    if (!is_sound) return;
    L = cholesky.matrixL();
    mean = -cholesky.solve(model.g);
  }

  int undetermined(const Eigen::VectorXd& scales) const {
    return static_cast<int>(
        (L.diagonal().array().square() < kUndeterminedShare * scales.array()).count());
  }
};

/// The marginal covariance of some rows, from the inverse of L.
Matrix covariance(const Matrix& L_inverse, Eigen::Index first, Eigen::Index size) {
  const auto columns = L_inverse.block(first, first, L_inverse.rows() - first, size);
  return columns.transpose() * columns;
}

/// Standard deviations of a position or distance, compressed over full, in the directions where the
/// ratio is smallest and largest.
std::pair<double, double> ratios(const Matrix& compressed, const Matrix& full) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(compressed, full,
                                                                Eigen::EigenvaluesOnly);
  const Eigen::VectorXd values = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return {values.minCoeff(), values.maxCoeff()};
}

void compareDeviations(const TangentRows& tangents, const Gaussian& full,
                       const Gaussian& compressed, Divergence* result) {
  const Matrix identity = Matrix::Identity(tangents.rows, tangents.rows);
  const Matrix full_inverse = lowerSolve(full.L, identity);
  const Matrix compressed_inverse = lowerSolve(compressed.L, identity);
  for (const NodeId node : tangents.nodes) {
    const bool is_keyframe = node.layer == Layer::kKeyframe;
    if (!is_keyframe && node.layer != Layer::kWall) continue;
    const Eigen::Index first = tangents.first_row.at(node) + (is_keyframe ? 0 : 2);
    const Eigen::Index size = is_keyframe ? 3 : 1;
    const auto [least, most] =
        ratios(covariance(compressed_inverse, first, size), covariance(full_inverse, first, size));
    if (!result->smallest || least < result->smallest->ratio) result->smallest = {node, least};
    if (!result->largest || most > result->largest->ratio) result->largest = {node, most};
  }
}

}  // namespace

Divergence divergence(const MarginalModel& full, const MarginalModel& compressed) {
  if (full.tangents.nodes != compressed.tangents.nodes) {
    throw std::invalid_argument("two marginals are not on the same nodes");
  }
  Divergence result;
  result.dof = full.tangents.rows;
  result.prior_share = kPriorShare;
  if (result.dof == 0) return result;
  const auto gaussian = [&](const MarginalModel& model) {
    return Gaussian(model, result.prior_share * full.scales);
  };
  Gaussian a = gaussian(full);
  Gaussian b = gaussian(compressed);
  while (!a.is_sound || !b.is_sound) {
    result.prior_share *= kMorePrior;
    if (result.prior_share > kMaxPriorShare) {
      throw std::runtime_error("an information is not positive semidefinite");
    }
    a = gaussian(full);
    b = gaussian(compressed);
  }
  result.undetermined_full = a.undetermined(full.scales) + full.undetermined;
  result.undetermined_compressed = b.undetermined(full.scales) + compressed.undetermined;

  const Eigen::VectorXd d = b.mean - a.mean;
  result.mean_to_full = (a.L.transpose() * d).squaredNorm();
  const double mean_to_compressed = (b.L.transpose() * d).squaredNorm();
  result.compressed_to_full = 0.5 * (excess(lowerSolve(b.L, a.L)) + result.mean_to_full);
  result.full_to_compressed = 0.5 * (excess(lowerSolve(a.L, b.L)) + mean_to_compressed);
  compareDeviations(full.tangents, a, b, &result);
  return result;
}

}  // namespace mrpt_sgraphs
