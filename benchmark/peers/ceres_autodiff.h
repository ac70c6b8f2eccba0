// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs::peers {

/// Our residuals as a user of Ceres would write them first: templates for automatic differentiation
/// over poses `x y z qx qy qz qw` and planes `nx ny nz d`.
struct AutodiffRelativePose {
  Pose measured;
  Matrix6 root;
  bool rotation_vector;  ///< Or the vector part of the quaternion.

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Quaternion = Eigen::Quaternion<T>;
    const Eigen::Map<const Vector> t_from(from), t_to(to);
    const Eigen::Map<const Quaternion> q_from(from + 3), q_to(to + 3);
    const Quaternion q_z = Eigen::Quaterniond(measured.linear()).cast<T>();
    const Vector t_z = measured.translation().cast<T>();
    Quaternion error = q_z.conjugate() * (q_from.conjugate() * q_to);
    if (error.w() < T(0)) error.coeffs() = -error.coeffs();
    Eigen::Matrix<T, 6, 1> e;
    e.template head<3>() = q_z.conjugate() * (q_from.conjugate() * (t_to - t_from) - t_z);
    if (rotation_vector) {
      const T w_first[] = {error.w(), error.x(), error.y(), error.z()};
      ceres::QuaternionToAngleAxis(w_first, e.data() + 3);
    } else {
      e.template tail<3>() = error.vec();
    }
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = root.cast<T>() * e;
    return true;
  }
};

struct AutodiffPlane {
  Plane measured;
  TangentBasis basis;
  Eigen::Matrix3d root;

  template <typename T>
  bool operator()(const T* pose, const T* plane, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector> t(pose), n(plane);
    const Eigen::Map<const Eigen::Quaternion<T>> q(pose + 3);
    Vector e;
    e.template head<2>() = basis.transpose().cast<T>() * (q.conjugate() * n);
    e[2] = plane[3] - n.dot(t) - T(measured.distance);
    Eigen::Map<Vector> out(residual);
    out = root.cast<T>() * e;
    return true;
  }
};

inline ceres::CostFunction* autodiff(const ResidualFactor<6, Pose, Pose>& factor,
                                     const Pose& T_from_to, bool rotation_vector) {
  return new ceres::AutoDiffCostFunction<AutodiffRelativePose, 6, 7, 7>(new AutodiffRelativePose{
      T_from_to, factor.information().llt().matrixU(), rotation_vector});
}

inline ceres::CostFunction* autodiff(const PlaneObservationFactor& factor) {
  return new ceres::AutoDiffCostFunction<AutodiffPlane, 3, 7, 4>(
      new AutodiffPlane{factor.measured_base, tangentBasis(factor.measured_base.normal),
                        factor.information().llt().matrixU()});
}

/// The manifolds that belong to them: Ceres' own.
inline ceres::Manifold* poseManifold() {
  return new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>;
}
inline ceres::Manifold* planeManifold() {
  return new ceres::ProductManifold<ceres::SphereManifold<3>, ceres::EuclideanManifold<1>>;
}

}  // namespace mrpt_sgraphs::peers
