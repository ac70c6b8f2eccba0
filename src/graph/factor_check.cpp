// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "factor_check.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

/// Of the largest entry: what rounding makes of an eigenvalue that is zero is smaller.
constexpr double kMaxNegative = 1e-8;
constexpr double kMaxError = 1e-6;  ///< Rounding errors that add up are smaller, mistakes larger.

void require(bool holds, const Factor& factor, const char* problem) {
  if (!holds) throw std::invalid_argument(describe(factor) + ": " + problem);
}

// Written so that NaN is refused.
bool isSound(const Pose& T) {
  const Eigen::Matrix3d R = T.linear();
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < kMaxError &&
         R.determinant() > 0.0 && T.translation().allFinite();
}
bool isSound(const Eigen::Vector3d& direction) {
  return std::abs(direction.norm() - 1.0) < kMaxError;
}
bool isSound(const Plane& plane) { return isSound(plane.normal) && std::isfinite(plane.distance); }

/// Cost and derivatives can be numbers though the measured rotation or direction is none.
bool isMeasurementSound(const Factor& factor) {
  if (const auto* f = dynamic_cast<const PlaneObservationFactor*>(&factor)) {
    return isSound(f->measured_base);
  }
  if (const auto* f = dynamic_cast<const RelativePoseFactor*>(&factor))
    return isSound(f->T_from_to);
  if (const auto* f = dynamic_cast<const RelativePoseQuaternionFactor*>(&factor)) {
    return isSound(f->T_from_to);
  }
  if (const auto* f = dynamic_cast<const RoomWallFactor*>(&factor)) return isSound(f->axis_room);
  if (const auto* f = dynamic_cast<const WallPairFactor*>(&factor)) {
    return isSound(Plane{f->normal_a_base, f->thickness_m});
  }
  if (const auto* f = dynamic_cast<const PosePriorFactor*>(&factor)) return isSound(f->prior_map);
  if (const auto* f = dynamic_cast<const PlanePriorFactor*>(&factor)) {
    return isSound(f->T_map_reference) && isSound(f->prior_reference);
  }
  if (const auto* f = dynamic_cast<const SummedObservationsFactor*>(&factor)) {
    return isSound(f->sum.reference_point);
  }
  if (const auto* f = dynamic_cast<const CondensedFactor*>(&factor)) {
    return std::all_of(f->others().begin(), f->others().end(), [](const auto& other) {
      return std::visit([](const auto& seen) { return isSound(seen); }, other.seen_kept);
    });
  }
  return true;
}

/// A Hessian of relative measurements is singular, and the pivots of such a matrix tell nothing:
/// after one that is zero but for rounding, the next may be anything. Shifted it is not.
bool isPositiveSemidefinite(const Eigen::MatrixXd& H) {
  const double largest = H.cwiseAbs().maxCoeff();
  if (largest == 0.0) return true;
  Eigen::MatrixXd shifted = H / largest;
  shifted.diagonal().array() += kMaxNegative;
  return shifted.llt().info() == Eigen::Success;
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

  require(isMeasurementSound(factor), factor, "the measurement is no pose or plane");

  const int rows = factor.tangentRows();
  Eigen::MatrixXd H(rows, rows);
  Eigen::VectorXd g(rows);
  const double cost = factor.linearize(values, H.data(), g.data());
  H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
  require(std::isfinite(cost) && g.allFinite() && H.allFinite(), factor,
          "measurement or information are not finite");
  require(isPositiveSemidefinite(H), factor, "the information is not positive semidefinite");
}

}  // namespace mrpt_sgraphs
