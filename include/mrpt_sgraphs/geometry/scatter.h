// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <array>

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {

/// What a plane has to know of its points: how many, their sum and the sum of their products. Two of
/// them add up; all in one frame, metres.
class Scatter {
 public:
  void add(const Eigen::Vector3d& p) {
    count_ += 1.0;
    sum_ += p;
    for (std::size_t k = 0; k < kPairs.size(); ++k) {
      products_[k] += p[kPairs[k].first] * p[kPairs[k].second];
    }
  }

  /// Points of a small region, summed up about its centre.
  static Scatter about(const Eigen::Vector3d& centre, double count, const Eigen::Vector3d& sum,
                       const std::array<double, 6>& products) {
    Scatter scatter;
    scatter.count_ = count;
    scatter.sum_ = sum + count * centre;
    for (std::size_t k = 0; k < kPairs.size(); ++k) {
      const auto [i, j] = kPairs[k];
      scatter.products_[k] =
          products[k] + centre[i] * sum[j] + sum[i] * centre[j] + count * centre[i] * centre[j];
    }
    return scatter;
  }

  Scatter& operator+=(const Scatter& other) {
    count_ += other.count_;
    sum_ += other.sum_;
    for (std::size_t k = 0; k < kPairs.size(); ++k) products_[k] += other.products_[k];
    return *this;
  }

  double count() const { return count_; }
  Eigen::Vector3d mean() const { return sum_ / count_; }

  /// Of the points about their mean, divided by their number [m^2].
  Eigen::Matrix3d covariance() const {
    const Eigen::Vector3d m = mean();
    Eigen::Matrix3d C;
    for (std::size_t k = 0; k < kPairs.size(); ++k) {
      const auto [i, j] = kPairs[k];
      C(i, j) = C(j, i) = products_[k] / count_ - m[i] * m[j];
    }
    return C;
  }

  /// The products' order: xx, xy, xz, yy, yz, zz.
  static constexpr std::array<std::pair<int, int>, 6> kPairs{
      {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

 private:
  double count_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  std::array<double, 6> products_{};
};

/// The plane that points lie on best, in the sense of total least squares, and how they lie on it.
struct FittedPlane {
  Plane plane;                    ///< Of either side.
  Eigen::Vector3d centroid{0.0, 0.0, 0.0};
  Eigen::Matrix3d axes;           ///< Columns: the normal, then the directions of the spreads.
  Eigen::Vector3d variance_m2{0.0, 0.0, 0.0};  ///< Along the axes, the least first.

  /// Distance from the plane, positive on the normal's side [m].
  double distance(const Eigen::Vector3d& p) const { return plane.normal.dot(p) - plane.distance; }
};

/// @param scatter  Of three points or more.
inline FittedPlane fitPlane(const Scatter& scatter) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter.covariance());
  FittedPlane fit;
  fit.centroid = scatter.mean();
  fit.axes = solver.eigenvectors();
  fit.variance_m2 = solver.eigenvalues().cwiseMax(0.0);
  fit.plane.normal = fit.axes.col(0).normalized();
  fit.plane.distance = fit.plane.normal.dot(fit.centroid);
  return fit;
}

}  // namespace mrpt_sgraphs
