// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/geometry/pose.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/Lie/SE.h>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

mrpt::math::CVectorFixedDouble<6> toMrpt(const Tangent& delta) {
  mrpt::math::CVectorFixedDouble<6> v;
  for (int k = 0; k < 6; ++k) v[k] = delta[k];
  return v;
}

class PoseTest : public ::testing::TestWithParam<double> {
 protected:
  test::RandomGeometry random_{1, GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Extents, PoseTest, ::testing::Values(1.0, 50.0, 500.0));

TEST_P(PoseTest, LocalUndoesRetract) {
  for (int trial = 0; trial < 1000; ++trial) {
    const Pose T = random_.pose();
    const Pose S = random_.pose();
    EXPECT_NEAR((retract(T, local(T, S)).matrix() - S.matrix()).norm(), 0.0, 1e-10 * GetParam());
  }
}

TEST_P(PoseTest, ExponentialAndLogarithmAreThoseOfMrpt) {
  for (int trial = 0; trial < 200; ++trial) {
    const Pose T = random_.pose();
    const Tangent delta = logPose(T);
    const auto by_mrpt = mrpt::poses::Lie::SE<3>::exp(toMrpt(delta));
    EXPECT_NEAR((by_mrpt.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
                 expPose(delta).matrix()).norm(), 0.0, 1e-10 * GetParam());
    const auto log_by_mrpt = mrpt::poses::Lie::SE<3>::log(by_mrpt);
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(log_by_mrpt[k], delta[k], 1e-7 * GetParam());
  }
}

TEST_P(PoseTest, AdjointMovesAPerturbationAlongARigidBody) {
  for (int trial = 0; trial < 100; ++trial) {
    const Pose T_map_body = random_.pose();
    const Pose T_body_other = random_.smallPose(2.0, 3.0);
    Tangent delta;
    delta << random_.vector(1e-6), random_.vector(1e-6);
    const Pose moved = retract(T_map_body, delta) * T_body_other;
    const Tangent seen = local(T_map_body * T_body_other, moved);
    EXPECT_NEAR((seen - adjointOfInverse(T_body_other) * delta).norm(), 0.0, 1e-9);
  }
}

TEST(Rotation, ExponentialAgreesWithAngleAxisDownToNothing) {
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-5, 1e-3, 1.0, 3.0}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_NEAR((expSO3(angle * axis) - expected).norm(), 0.0, 1e-14) << angle;
    EXPECT_NEAR((logSO3(expected) - angle * axis).norm(), 0.0, 1e-12) << angle;
  }
}

TEST(Interpolation, StartsAtOneEndAndEndsAtTheOther) {
  test::RandomGeometry random(2, 10.0);
  const Pose A = random.pose();
  const Pose B = random.pose();
  EXPECT_TRUE(interpolate(A, B, 0.0).isApprox(A, 1e-12));
  EXPECT_TRUE(interpolate(A, B, 1.0).isApprox(B, 1e-9));
  const Pose middle = interpolate(A, B, 0.5);
  EXPECT_NEAR(local(A, middle).tail<3>().norm(), local(middle, B).tail<3>().norm(), 1e-9);
}

}  // namespace
}  // namespace mrpt_sgraphs
