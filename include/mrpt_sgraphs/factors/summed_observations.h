// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>

#include "mrpt_sgraphs/factors/plane_observation.h"

namespace mrpt_sgraphs {

/// What any number of keyframes that do not move say on one wall or floor, in one matrix.
///
/// The residual of a plane observation from a fixed keyframe is linear in (n, d), so the sum of
/// their costs is a quadratic of four variables, exactly and for any plane:
///
///     sum e' Omega e = x' A x - 2 b' x + c,   x = (n - n_0, d - n . p - d_0)          x in R^4
///
/// The plane (n_0, d_0) and the point p, from which its distance is measured, change nothing but
/// the rounding: with x small and p nearby, no large numbers cancel far away from the map's origin.
struct ObservationSum {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double c = 0.0;
  Eigen::Vector3d point_map = Eigen::Vector3d::Zero();  ///< p [m]
  Plane reference_point;  ///< (n_0, d_0), its distance from `point_map`, not from the map's origin.

  ObservationSum() = default;

  /// @param surface_map  Near the plane to be found, as it is when the sum is begun.
  /// @param near_map     A point near the keyframes [m].
  ObservationSum(const Plane& surface_map, const Eigen::Vector3d& near_map)
      : point_map(near_map),
        reference_point{surface_map.normal,
                        surface_map.distance - surface_map.normal.dot(near_map)} {}

  /// @throws std::invalid_argument if the observation has a robust kernel: then it is no quadratic.
  void add(const PlaneObservationFactor& observation, const Pose& T_map_base) {
    if (observation.kernel().kind != RobustKernel::Kind::kNone) {
      throw std::invalid_argument("An observation with a robust kernel cannot be summed.");
    }
    Pose T_point_base = T_map_base;
    T_point_base.translation() -= point_map;
    const Eigen::Vector3d e = observation.evaluate(T_point_base, reference_point, nullptr, nullptr);
    Eigen::Matrix<double, 3, 4> J;  // of e with x
    J.topLeftCorner<2, 3>() = tangentBasis(observation.measured_base.normal).transpose() *
                              T_point_base.linear().transpose();
    J.topRightCorner<2, 1>().setZero();
    J.bottomRows<1>() << -T_point_base.translation().transpose(), 1.0;

    const Eigen::Matrix<double, 4, 3> weighted = J.transpose() * observation.information();
    A += weighted * J;
    b -= weighted * e;
    c += e.dot(observation.information() * e);
  }
};

/// The observations of a wall or floor from keyframes that stay where they are, summed up: what the
/// window of Sec. III-B costs does not grow with what has been seen before.
///
/// Absolute, as priors are: when those keyframes move, the sum is to be made again.
class SummedObservationsFactor final : public Factor {
 public:
  SummedObservationsFactor(NodeId surface, const ObservationSum& sum)
      : sum(sum), surface_(surface) {}

  const char* type() const override { return "summed_observations"; }
  int nodeCount() const override { return 1; }
  NodeId node(int) const override { return surface_; }

  double cost(const VariableView* values) const override {
    const Eigen::Vector4d x = coordinates(values[0].as<Plane>());
    return x.dot(sum.A * x - 2.0 * sum.b) + sum.c;
  }

  double linearize(const VariableView* values, double* H, double* g) const override {
    const Plane& surface_map = values[0].as<Plane>();
    const Eigen::Vector4d x = coordinates(surface_map);
    const TangentBasis basis = tangentBasis(surface_map.normal);
    Eigen::Matrix<double, 4, 3> J;  // of x with the plane's tangent
    J << basis, Eigen::Vector3d::Zero(), -sum.point_map.transpose() * basis, 1.0;

    const Eigen::Vector4d A_x = sum.A * x;
    Eigen::Map<Eigen::Matrix3d>(H).noalias() = J.transpose() * (sum.A * J);
    Eigen::Map<Eigen::Vector3d>(g).noalias() = J.transpose() * (A_x - sum.b);
    return x.dot(A_x - 2.0 * sum.b) + sum.c;
  }

  const ObservationSum sum;

 private:
  Eigen::Vector4d coordinates(const Plane& surface_map) const {
    Eigen::Vector4d x;
    x << surface_map.normal - sum.reference_point.normal,
        surface_map.distance - surface_map.normal.dot(sum.point_map) - sum.reference_point.distance;
    return x;
  }

  NodeId surface_;
};

}  // namespace mrpt_sgraphs
