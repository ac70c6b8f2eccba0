// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "mrpt_sgraphs/factors/summed_observations.h"
#include "support/factor_laws.h"

namespace mrpt_sgraphs {
namespace {

const WallId kWall{3};

class SummedObservationsTest : public ::testing::TestWithParam<double> {
 protected:
  struct Seen {
    Pose T_map_base;
    PlaneObservationFactor observation;
  };

  /// A wall seen from 100 places within 10 m, to a centimetre and to 0.6 deg, not without noise.
  void SetUp() override {
    T_map_local_ = random_.pose();
    wall_map_ = T_map_local_ * Plane{test::randomDirection(&random_), 2.0};
    Eigen::Vector3d weights(1e4, 1e4, 1e4);
    for (int k = 0; k < 100; ++k) {
      const Pose T_map_base = T_map_local_ * random_.smallPose(10.0, 3.0);
      const Plane seen_base = random_.smallPose(0.02, 0.01) * inverseTimes(T_map_base, wall_map_);
      Eigen::Matrix3d information = weights.asDiagonal();
      information += 1e3 * test::randomInformation<3>(&random_);
      seen_.push_back({T_map_base, {KeyframeId{1}, kWall, seen_base, information}});
    }
  }

  SummedObservationsFactor summed(const Pose& T_other_map) const {
    const Plane begun = retract(wall_map_, PlaneTangent(0.02, -0.01, 0.05));
    ObservationSum sum(T_other_map * begun, (T_other_map * T_map_local_).translation());
    for (const Seen& seen : seen_) sum.add(seen.observation, T_other_map * seen.T_map_base);
    return {kWall, sum};
  }

  /// The sum of the single factors, over the wall alone.
  test::Linearized oneByOne(const Plane& wall_map) const {
    test::Linearized sum{0.0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()};
    for (const Seen& seen : seen_) {
      const auto one = test::linearize(seen.observation, {seen.T_map_base, wall_map});
      sum.cost += one.cost;
      sum.H += one.H.bottomRightCorner<3, 3>();
      sum.g += one.g.tail<3>();
    }
    return sum;
  }

  Plane nearWall() { return retract(wall_map_, random_.vector(0.05)); }

  test::RandomGeometry random_{17, GetParam()};
  Pose T_map_local_ = Pose::Identity();
  Plane wall_map_;
  std::vector<Seen> seen_;
};
INSTANTIATE_TEST_SUITE_P(Extents, SummedObservationsTest, ::testing::Values(1.0, 50.0, 500.0));

TEST_P(SummedObservationsTest, IsTheSumOfTheSingleFactorsForAnyPlane) {
  const SummedObservationsFactor factor = summed(Pose::Identity());
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    const Plane wall_map =
        trial % 2 == 0 ? nearWall() : T_map_local_ * test::randomPlane(&random_, 10.0);
    const test::Linearized expected = oneByOne(wall_map);
    const test::Linearized got = test::linearize(factor, {wall_map});
    EXPECT_NEAR(got.cost, expected.cost, 1e-9 * expected.cost);
    EXPECT_NEAR((got.g - expected.g).norm(), 0.0, 1e-9 * expected.g.norm());
    EXPECT_NEAR((got.H - expected.H).norm(), 0.0, 1e-9 * expected.H.norm());
    EXPECT_EQ(got.cost, factor.cost(test::views({wall_map}).data()));
  }
}

TEST_P(SummedObservationsTest, DoesNotDependOnWhereTheMapOriginIs) {
  const Pose T_other_map = random_.pose();
  const SummedObservationsFactor factor = summed(Pose::Identity());
  const SummedObservationsFactor factor_moved = summed(T_other_map);
  for (int trial = 0; trial < 20; ++trial) {
    const Plane wall_map = nearWall();
    const double cost = factor.cost(test::views({wall_map}).data());
    EXPECT_NEAR(factor_moved.cost(test::views({T_other_map * wall_map}).data()), cost, 1e-9 * cost);
  }
}

TEST_P(SummedObservationsTest, GradientMatchesDifferencesOfTheCost) {
  const SummedObservationsFactor factor = summed(Pose::Identity());
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    test::expectGradientMatches(factor, {nearWall()});
  }
}

TEST_P(SummedObservationsTest, RefusesARobustKernel) {
  const PlaneObservationFactor robust(KeyframeId{1}, kWall, Plane{}, Eigen::Matrix3d::Identity(),
                                      {RobustKernel::Kind::kHuber, 1.0});
  ObservationSum sum;
  EXPECT_THROW(sum.add(robust, Pose::Identity()), std::invalid_argument);
}

}  // namespace
}  // namespace mrpt_sgraphs
