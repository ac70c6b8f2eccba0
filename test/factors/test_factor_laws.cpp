// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <memory>

#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "support/factor_laws.h"

namespace mrpt_sgraphs {
namespace {

using test::Values;

constexpr double kFar_m = 10.0;   ///< How far a pose sees.
constexpr double kShift_m = 0.5;  ///< How far a node is from where it should be.
constexpr double kTurn_rad = 0.5;

const KeyframeId kKeyframe{1};
const KeyframeId kOther{2};
const WallId kWall{3};
const WallId kFace{4};
const RoomId kRoom{5};
const FloorId kFloor{6};

/// The three laws, for every factor with a residual: zero at its measurement, unchanged when the
/// map's origin moves, Jacobians equal to central differences. The parameter is the distance from
/// the map's origin [m].
class FactorLaws : public ::testing::TestWithParam<double> {
 protected:
  /// Runs the laws for 20 worlds. `build(T_map_base)` returns {make, values}: make(T_other_map) is
  /// the factor for a map whose origin has moved (all but priors ignore it), the values are those
  /// at its measurement.
  template <typename Build>
  void check(const Build& build) {
    for (int trial = 0; trial < 20; ++trial) {
      SCOPED_TRACE(trial);
      const auto [make, at_measurement] = build(random_.pose());
      const Pose T_other_map = random_.pose();
      const auto factor = make(Pose::Identity());
      const auto factor_moved = make(T_other_map);
      const double rounding = 1e-12 * (1.0 + GetParam());

      EXPECT_NEAR(test::evaluate(factor, at_measurement).norm(), 0.0, rounding);

      const Values values = test::retracted(at_measurement, disturbance(factor));
      const Eigen::VectorXd e = test::evaluate(factor, values);
      EXPECT_GT(e.norm(), 1e-3);
      const Eigen::VectorXd e_moved =
          test::evaluate(factor_moved, test::moved(T_other_map, values));
      EXPECT_NEAR((e - e_moved).norm(), 0.0, 10.0 * rounding);

      test::expectJacobiansMatch(factor, values);
      test::expectLinearizeMatches(factor, values);
      test::expectGradientMatches(factor, values);
    }
  }

  Eigen::VectorXd disturbance(const Factor& factor) {
    Eigen::VectorXd delta(factor.tangentRows());
    Eigen::Index row = 0;
    for (int k = 0; k < factor.nodeCount(); ++k) {
      if (isPlane(factor.node(k).layer)) {
        delta.segment<3>(row) << random_.number(0.3), random_.number(0.3), random_.number(kShift_m);
      } else {
        delta.segment<6>(row) << random_.vector(kShift_m), random_.vector(kTurn_rad);
      }
      row += tangentSize(factor.node(k).layer);
    }
    return delta;
  }

  /// Sometimes none, sometimes one, with the residuals on both sides of its width.
  RobustKernel kernel() {
    const auto kind = static_cast<RobustKernel::Kind>(std::abs(random_.number(2.999)));
    return {kind, std::exp(random_.number(3.0))};
  }

  test::RandomGeometry random_{7, GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Extents, FactorLaws, ::testing::Values(1.0, 50.0, 500.0));

TEST_P(FactorLaws, RelativePose) {
  check([this](const Pose& T_map_from) {
    const Pose T_from_to = random_.smallPose(kFar_m, 2.0);
    const RelativePoseFactor factor(kKeyframe, kOther, T_from_to,
                                    test::randomInformation<6>(&random_),
                                    RelativePoseFactor::Kind::kOdometry, kernel());
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_from, T_map_from * T_from_to});
  });
}

TEST_P(FactorLaws, RelativePoseQuaternion) {
  check([this](const Pose& T_map_from) {
    const Pose T_from_to = random_.smallPose(kFar_m, 2.0);
    const RelativePoseQuaternionFactor factor(kKeyframe, kOther, T_from_to,
                                              test::randomInformation<6>(&random_), kernel());
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_from, T_map_from * T_from_to});
  });
}

TEST_P(FactorLaws, PlaneObservation) {
  check([this](const Pose& T_map_base) {
    const Plane seen_base = test::randomPlane(&random_, kFar_m);
    const PlaneObservationFactor factor(kKeyframe, kWall, seen_base,
                                        test::randomInformation<3>(&random_), kernel());
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_base, T_map_base * seen_base});
  });
}

TEST_P(FactorLaws, RoomWall) {
  check([this](const Pose& T_map_room) {
    const Eigen::Vector3d axis_room = expSO3({0.0, 0.0, random_.number(M_PI)}).col(0);
    const RoomWallFactor factor(kRoom, kWall, axis_room, test::randomInformation<2>(&random_),
                                kernel());
    const Plane wall_room{axis_room, random_.number(kFar_m)};
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_room, T_map_room * wall_room});
  });
}

TEST_P(FactorLaws, RoomCentre) {
  check([this](const Pose& T_map_room) {
    const RoomCentreFactor factor(kRoom, kWall, kFace, test::randomInformation<1>(&random_),
                                  kernel());
    const Plane a_room = test::randomPlane(&random_, kFar_m);
    const Plane b_room{-a_room.normal, a_room.distance};
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_room, T_map_room * a_room, T_map_room * b_room});
  });
}

TEST_P(FactorLaws, FloorRoom) {
  check([this](const Pose& T_map_room) {
    const FloorRoomFactor factor(kFloor, kRoom, test::randomInformation<3>(&random_), kernel());
    const Plane ground_room{Eigen::Vector3d::UnitZ(), 0.0};
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_room * ground_room, T_map_room});
  });
}

TEST_P(FactorLaws, WallPair) {
  check([this](const Pose& T_map_base) {
    const Plane a_base = test::randomPlane(&random_, kFar_m);
    const double thickness_m = 0.1 + std::abs(random_.number(0.3));
    const Plane b_base{-a_base.normal, thickness_m - a_base.distance};
    const WallPairFactor factor(kKeyframe, kWall, kFace, a_base.normal, thickness_m,
                                test::randomInformation<3>(&random_), kernel());
    return std::make_pair([factor](const Pose&) { return factor; },
                          Values{T_map_base, T_map_base * a_base, T_map_base * b_base});
  });
}

TEST_P(FactorLaws, PosePrior) {
  check([this](const Pose& prior_map) {
    const Matrix6 information = test::randomInformation<6>(&random_);
    const RobustKernel robust = kernel();
    return std::make_pair(
        [=](const Pose& T_other_map) {
          return PosePriorFactor(kRoom, T_other_map * prior_map, information, robust);
        },
        Values{prior_map});
  });
}

TEST_P(FactorLaws, PlanePrior) {
  check([this](const Pose& T_map_reference) {
    const Plane prior_reference = test::randomPlane(&random_, kFar_m);
    const Eigen::Matrix3d information = test::randomInformation<3>(&random_);
    const RobustKernel robust = kernel();
    return std::make_pair(
        [=](const Pose& T_other_map) {
          return PlanePriorFactor(kFloor, T_other_map * T_map_reference, prior_reference,
                                  information, robust);
        },
        Values{T_map_reference * prior_reference});
  });
}

}  // namespace
}  // namespace mrpt_sgraphs
