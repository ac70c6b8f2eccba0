// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dense_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <utility>

namespace mrpt_sgraphs {
namespace {

constexpr double kGuard = 12345.0;

/// A front with its memory, filled from a symmetric matrix and a right-hand side.
struct TestFront {
  TestFront(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, int pivots)
      : panel(FrontView::panelSize(pivots, static_cast<int>(H.rows()) - pivots) + 1, 0.0),
        update(FrontView::updateSize(static_cast<int>(H.rows()) - pivots) + 1, 0.0) {
    view.panel = panel.data();
    view.update = update.data();
    view.pivots = pivots;
    view.rows = static_cast<int>(H.rows()) - pivots;
    for (int c = 0; c < H.cols(); ++c) {
      for (int r = c; r < H.rows(); ++r) at(r, c) = H(r, c);
      at(static_cast<int>(H.rows()), c) = g(c);
    }
    panel.back() = update.back() = kGuard;
  }
  double& at(int row, int column) {
    const int p = view.pivots;
    return column < p ? panel[static_cast<std::size_t>(column * view.panelStride() + row)]
                      : update[static_cast<std::size_t>((column - p) * view.updateStride() + row - p)];
  }
  std::vector<double> panel;
  std::vector<double> update;
  FrontView view;
};

class EliminatePivots : public ::testing::TestWithParam<std::pair<int, int>> {};

// Below, at and above the sizes at which vectors, blocks and packing begin.
INSTANTIATE_TEST_SUITE_P(
    Sizes, EliminatePivots,
    ::testing::Values(std::make_pair(3, 0), std::make_pair(3, 9), std::make_pair(6, 0),
                      std::make_pair(6, 24), std::make_pair(6, 200), std::make_pair(9, 12),
                      std::make_pair(12, 31), std::make_pair(47, 3), std::make_pair(48, 60),
                      std::make_pair(49, 61), std::make_pair(96, 33), std::make_pair(99, 102),
                      std::make_pair(150, 0), std::make_pair(147, 210)));

TEST_P(EliminatePivots, IsThePartialCholeskyFactorization) {
  const auto [p, m] = GetParam();
  srand(static_cast<unsigned>(p + 1000 * m));
  const Eigen::MatrixXd J = Eigen::MatrixXd::Random(p + m + 10, p + m);
  const Eigen::MatrixXd H = J.transpose() * J + Eigen::MatrixXd::Identity(p + m, p + m);
  const Eigen::VectorXd g = Eigen::VectorXd::Random(p + m);
  TestFront front(H, g, p);
  EliminationScratch scratch;
  std::vector<LostPivot> lost;
  eliminatePivots(front.view, std::vector<double>(static_cast<std::size_t>(p), 1e-12).data(),
                  &scratch, &lost);

  EXPECT_TRUE(lost.empty());
  const Eigen::MatrixXd L = H.topLeftCorner(p, p).llt().matrixL();
  const Eigen::MatrixXd B =
      L.triangularView<Eigen::Lower>().solve(H.bottomLeftCorner(m, p).transpose()).transpose();
  const Eigen::VectorXd y = L.triangularView<Eigen::Lower>().solve(g.head(p));
  const Eigen::MatrixXd left = H.bottomRightCorner(m, m) - B * B.transpose();
  const Eigen::VectorXd left_g = g.tail(m) - B * y;
  const double tolerance = 1e-12 * H.norm();
  for (int c = 0; c < p; ++c) {
    for (int r = c; r < p; ++r) EXPECT_NEAR(front.at(r, c), L(r, c), tolerance);
    for (int r = 0; r < m; ++r) EXPECT_NEAR(front.at(p + r, c), B(r, c), tolerance);
    EXPECT_NEAR(front.at(p + m, c), y(c), tolerance);
  }
  for (int c = 0; c < m; ++c) {
    for (int r = c; r < m; ++r) EXPECT_NEAR(front.at(p + r, p + c), left(r, c), tolerance);
    EXPECT_NEAR(front.at(p + m, p + c), left_g(c), tolerance);
  }
  EXPECT_EQ(front.panel.back(), kGuard);
  EXPECT_EQ(front.update.back(), kGuard);

  // and back: L' x = y - B' x_later
  const Eigen::VectorXd later = Eigen::VectorXd::Random(m);
  Eigen::VectorXd x(p);
  substituteBack(front.view.panel, p, m, y.data(), later.data(), x.data());
  const Eigen::VectorXd expected =
      L.transpose().triangularView<Eigen::Upper>().solve(y - B.transpose() * later);
  EXPECT_NEAR((x - expected).norm(), 0.0, 1e-10 * (1.0 + expected.norm()));
}

TEST(EliminatePivots, HoldsWhatNothingDetermines) {
  // x1 - x0 is known, x0 is not: the second pivot is lost
  Eigen::MatrixXd H(3, 3);
  H << 1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 4.0;
  const Eigen::Vector3d g(1.0, -1.0, 2.0);
  TestFront front(H, g, 3);
  EliminationScratch scratch;
  std::vector<LostPivot> lost;
  const double min_pivots[3] = {1e-14, 1e-14, 1e-14};
  eliminatePivots(front.view, min_pivots, &scratch, &lost);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().column, 1);
  EXPECT_EQ(front.at(1, 1), 1.0);
  EXPECT_EQ(front.at(2, 1), 0.0);
  EXPECT_EQ(front.at(3, 1), 0.0);  // its right-hand side: the solution is zero there
  EXPECT_EQ(front.at(2, 2), 2.0);
}

TEST(EliminatePivots, NotesANumberThatIsNone) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(3, 3);
  H(1, 1) = std::numeric_limits<double>::quiet_NaN();
  TestFront front(H, Eigen::Vector3d::Ones(), 3);
  EliminationScratch scratch;
  std::vector<LostPivot> lost;
  const double min_pivots[3] = {0.0, 0.0, 0.0};
  eliminatePivots(front.view, min_pivots, &scratch, &lost);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().column, 1);
}

}  // namespace
}  // namespace mrpt_sgraphs
