// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "support/factor_laws.h"

namespace mrpt_sgraphs {
namespace {

// Half a turn has two rotation vectors; whichever it is, what comes out are numbers.
TEST(RelativePoseAtHalfATurn, StaysFinite) {
  test::RandomGeometry random(5, 10.0);
  for (const double off_rad : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    for (const int axis : {0, 1, 2, 3}) {
      const Eigen::Vector3d direction =
          axis < 3 ? Eigen::Vector3d::Unit(axis) : random.vector(1.0).normalized().eval();
      Pose T_from_to = Pose::Identity();
      T_from_to.linear() = Eigen::AngleAxisd(M_PI - off_rad, direction).toRotationMatrix();
      const Pose T_map_from = random.pose();
      const RelativePoseFactor factor(KeyframeId{1}, KeyframeId{2}, Pose::Identity(),
                                      Matrix6::Identity());
      const RelativePoseQuaternionFactor quaternion_factor(KeyframeId{1}, KeyframeId{2},
                                                           Pose::Identity(), Matrix6::Identity());
      const test::Values values{T_map_from, T_map_from * T_from_to};
      const test::Linearized got = test::linearize(factor, values);
      EXPECT_TRUE(got.H.allFinite() && got.g.allFinite());
      EXPECT_NEAR(std::sqrt(got.cost), M_PI - off_rad, 1e-7);
      const test::Linearized got_quaternion = test::linearize(quaternion_factor, values);
      EXPECT_TRUE(got_quaternion.H.allFinite() && got_quaternion.g.allFinite());
      EXPECT_NEAR(got_quaternion.cost, 1.0, 1e-6);
      if (off_rad == 1e-3) test::expectJacobiansMatch(factor, values);
    }
  }
}

// What a g2o file means: half the rotation vector for small angles, and the same whichever sign the
// quaternion has.
TEST(RelativePoseQuaternion, IsHalfTheRotationVectorWhenSmall) {
  const Tangent delta = (Tangent() << 0.1, -0.2, 0.3, 1e-4, -2e-4, 3e-4).finished();
  const RelativePoseQuaternionFactor factor(KeyframeId{1}, KeyframeId{2}, Pose::Identity(),
                                            Matrix6::Identity());
  const auto e = factor.evaluate(Pose::Identity(), expPose(delta), nullptr, nullptr);
  EXPECT_NEAR((e.head<3>() - delta.head<3>()).norm(), 0.0, 1e-15);
  EXPECT_NEAR((e.tail<3>() - 0.5 * delta.tail<3>()).norm(), 0.0, 1e-11);
}

TEST(RelativePoseQuaternion, TakesTheShorterWayRound) {
  const RelativePoseQuaternionFactor factor(KeyframeId{1}, KeyframeId{2}, Pose::Identity(),
                                            Matrix6::Identity());
  for (const double angle_rad : {-3.0, -2.0, 2.0, 3.0, 3.5, 4.0}) {
    const Pose T = expPose((Tangent() << Eigen::Vector3d::Zero(), 0.0, 0.0, angle_rad).finished());
    const double shorter_rad = std::remainder(angle_rad, 2.0 * M_PI);
    const auto e = factor.evaluate(Pose::Identity(), T, nullptr, nullptr);
    EXPECT_NEAR(e(5), std::sin(0.5 * shorter_rad), 1e-12) << angle_rad;
  }
}

TEST(ResidualFactor, RefusesANodeThatHasAnotherTypeOfVariable) {
  const Matrix6 information = Matrix6::Identity();
  EXPECT_THROW(RelativePoseFactor(KeyframeId{0}, WallId{1}, Pose::Identity(), information),
               std::invalid_argument);
  EXPECT_THROW(PlaneObservationFactor(KeyframeId{0}, RoomId{1}, Plane{},
                                      Eigen::Matrix3d::Identity()),
               std::invalid_argument);
  EXPECT_NO_THROW(RelativePoseFactor(KeyframeId{0}, RoomId{1}, Pose::Identity(), information));
}

}  // namespace
}  // namespace mrpt_sgraphs
