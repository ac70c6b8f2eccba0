// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "factor_check.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

/// Of the largest entry: what rounding makes of an eigenvalue that is zero is smaller.
constexpr double kMaxNegative = 1e-8;

void require(bool holds, const Factor& factor, const char* problem) {
  if (!holds) throw std::invalid_argument(describe(factor) + ": " + problem);
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

/// Its own, and not only what is left of it where the nodes are: a robust kernel may weigh it down.
template <typename AnyFactor>
void requireInformation(const AnyFactor& factor) {
  constexpr double kMaxAsymmetry = 1e-6;
  const Eigen::MatrixXd information = factor.information();
  require((information - information.transpose()).norm() <= kMaxAsymmetry * information.norm(),
          factor, "the information is not symmetric, or not finite");
  require(isPositiveSemidefinite(information), factor,
          "the information is not positive semidefinite");
}

/// @return Whether it is such a factor.
template <typename AnyFactor, typename IsMeasured>
bool checkedAs(const Factor& factor, const IsMeasured& is_measured) {
  const auto* const of_this_type = dynamic_cast<const AnyFactor*>(&factor);
  if (of_this_type == nullptr) return false;
  require(is_measured(*of_this_type), factor, "the measurement is no pose or plane");
  requireInformation(*of_this_type);
  return true;
}

/// Cost and derivatives can be numbers though a measured rotation or direction is none.
void requireSoundParts(const Factor& factor) {
  using Quaternion = RelativePoseQuaternionFactor;
  const auto always = [](const auto&) { return true; };
  if (checkedAs<PlaneObservationFactor>(factor,
                                        [](const auto& f) { return isSound(f.measured_base); }) ||
      checkedAs<RelativePoseFactor>(factor, [](const auto& f) { return isSound(f.T_from_to); }) ||
      checkedAs<Quaternion>(factor, [](const auto& f) { return isSound(f.T_from_to); }) ||
      checkedAs<RoomWallFactor>(factor,
                                [](const auto& f) { return isSound(Plane{f.axis_room, 0.0}); }) ||
      checkedAs<RoomCentreFactor>(factor, always) || checkedAs<FloorRoomFactor>(factor, always) ||
      checkedAs<WallPairFactor>(factor,
                                [](const auto& f) {
                                  return isSound(Plane{f.normal_a_base, f.thickness_m});
                                }) ||
      checkedAs<PosePriorFactor>(factor, [](const auto& f) { return isSound(f.prior_map); }) ||
      checkedAs<PlanePriorFactor>(factor, [](const auto& f) {
        return isSound(f.T_map_reference) && isSound(f.prior_reference);
      })) {
    return;
  }
  bool measured = true;
  if (const auto* sum = dynamic_cast<const SummedObservationsFactor*>(&factor)) {
    measured = isSound(sum->sum.reference_point);
  } else if (const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor)) {
    for (const CondensedFactor::Other& other : condensed->others()) {
      measured =
          measured && std::visit([](const auto& seen) { return isSound(seen); }, other.seen_kept);
    }
  }
  require(measured, factor, "the measurement is no pose or plane");
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
  requireSoundParts(factor);

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
