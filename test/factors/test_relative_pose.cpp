// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/factors/relative_pose.h"

#include <gtest/gtest.h>

#include "support/numerical_jacobian.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

class RelativePoseTest : public ::testing::TestWithParam<double> {
 protected:
  test::RandomGeometry random_{3, GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Extents, RelativePoseTest, ::testing::Values(1.0, 50.0, 500.0));

TEST_P(RelativePoseTest, IsZeroAtItsMeasurement) {
  const Pose T_map_from = random_.pose();
  const Pose T_from_to = random_.smallPose(2.0, 3.0);
  const Tangent e = relativePoseResidual(T_from_to, T_map_from, T_map_from * T_from_to, nullptr,
                                         nullptr);
  EXPECT_NEAR(e.norm(), 0.0, 1e-12 * (1.0 + GetParam()));
}

TEST_P(RelativePoseTest, DoesNotDependOnWhereTheMapOriginIs) {
  const Pose T_map_from = random_.pose();
  const Pose T_map_to = T_map_from * random_.smallPose(2.0, 1.0);
  const Pose measured = random_.smallPose(2.0, 1.0);
  const Pose T_other_map = random_.pose();
  const Tangent e = relativePoseResidual(measured, T_map_from, T_map_to, nullptr, nullptr);
  const Tangent e_other = relativePoseResidual(measured, T_other_map * T_map_from,
                                               T_other_map * T_map_to, nullptr, nullptr);
  EXPECT_NEAR((e - e_other).norm(), 0.0, 1e-9);
}

TEST_P(RelativePoseTest, JacobiansMatchCentralDifferences) {
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Pose T_map_from = random_.pose();
    const Pose T_map_to = T_map_from * random_.smallPose(3.0, 1.0);
    const Pose measured = random_.smallPose(3.0, 0.6);
    Matrix6 J_from;
    Matrix6 J_to;
    relativePoseResidual(measured, T_map_from, T_map_to, &J_from, &J_to);
    const Matrix6 numeric_from = test::centralDifferences(
        [&](const Pose& T) {
          return relativePoseResidual(measured, T, T_map_to, nullptr, nullptr);
        },
        T_map_from);
    const Matrix6 numeric_to = test::centralDifferences(
        [&](const Pose& T) {
          return relativePoseResidual(measured, T_map_from, T, nullptr, nullptr);
        },
        T_map_to);
    EXPECT_NEAR((J_from - numeric_from).cwiseAbs().maxCoeff(), 0.0, 1e-6);
    EXPECT_NEAR((J_to - numeric_to).cwiseAbs().maxCoeff(), 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
