// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Whether points that look like a plane's follow a parabola: a pillar, a vault.
class BendTest {
 public:
  /// @param spread_u_m, spread_v_m  One sigma of where the points are in the plane.
  BendTest(double spread_u_m, double spread_v_m)
      : per_u_(1.0 / std::max(spread_u_m, kMinSpread_m)),
        per_v_(1.0 / std::max(spread_v_m, kMinSpread_m)) {}

  /// @param u_m, v_m  From the points' mean.
  void add(double weight, double u_m, double v_m, double height_m) {
    const double u = u_m * per_u_;
    const double v = v_m * per_v_;
    Vector6 row;
    row << 1.0, u, v, u * u, u * v, v * v;
    normal_.noalias() += weight * row * row.transpose();
    right_.noalias() += weight * height_m * row;
    weight_ += weight;
  }

  /// @param sigma_m  Of a point of weight 1 about the surface.
  bool isBent(double sigma_m) const {
    Matrix6 normal = normal_;
    // in one row of points there is no bend across it
    normal.diagonal().array() += kDamping * weight_;
    const Eigen::LDLT<Matrix6> solver(normal);
    const Vector6 bend_m = solver.solve(right_);
    const Matrix6 covariance = solver.solve(Matrix6::Identity());
    for (const int k : {3, 5}) {
      const double error_m = sigma_m * std::sqrt(covariance(k, k));
      if (std::abs(bend_m[k]) > std::max(kSignificance * error_m, kMinBend_m)) return true;
    }
    return false;
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  static constexpr double kMinSpread_m = 0.01;
  static constexpr double kDamping = 1e-3;
  static constexpr double kSignificance = 6.0;
  /// One sigma away from the middle; scans that were gathered may bend a flat wall by less.
  static constexpr double kMinBend_m = 0.005;

  double per_u_, per_v_;
  Matrix6 normal_ = Matrix6::Zero();
  Vector6 right_ = Vector6::Zero();
  double weight_ = 0.0;
};

}  // namespace mrpt_sgraphs
