// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

TEST(PlaneFrame, IsRightHandedWithULevelAndVUp) {
  test::RandomGeometry random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Plane plane{random.vector(1.0).normalized(), random.number(3.0)};
    const PlaneFrame frame(plane, Eigen::Vector3d(300.0, -200.0, 4.0));
    EXPECT_NEAR((frame.u.cross(frame.v) - plane.normal).norm(), 0.0, 1e-12);
    EXPECT_NEAR(plane.normal.dot(frame.origin), plane.distance, 1e-9);
    EXPECT_NEAR(frame.u.z(), 0.0, 0.05);
    EXPECT_GE(frame.v.z(), -0.05);
    const Eigen::Vector3d point = frame.lifted({2.0, -3.0});
    EXPECT_NEAR(plane.normal.dot(point), plane.distance, 1e-9);
    EXPECT_NEAR((frame.flat(point) - Eigen::Vector2d(2.0, -3.0)).norm(), 0.0, 1e-9);
  }
}

TEST(PlaneFrame, IsGoodForALevelPlaneToo) {
  for (const double side : {1.0, -1.0}) {
    const PlaneFrame frame({side * Eigen::Vector3d::UnitZ(), 1.0}, Eigen::Vector3d(5.0, 6.0, 7.0));
    EXPECT_NEAR((frame.u.cross(frame.v) - frame.normal).norm(), 0.0, 1e-12);
    EXPECT_NEAR((frame.origin - Eigen::Vector3d(5.0, 6.0, side)).norm(), 0.0, 1e-12);
  }
}

TEST(PlaneFrame, LiftedExtentsComeBack) {
  const PlaneFrame frame({Eigen::Vector3d::UnitX(), 2.0}, Eigen::Vector3d::Zero());
  const FlatExtent extent{{{0.0, 0.0}, {4.0, 0.0}, {0.0, 3.0}},
                          {{{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}}}};
  const PlanarExtent in_space = lifted(extent, frame);
  EXPECT_NEAR((in_space.outline[1] - Eigen::Vector3d(2.0, 4.0, 0.0)).norm(), 0.0, 1e-12);
  const FlatExtent back = flattened(in_space, frame);
  ASSERT_EQ(back.holes.size(), 1U);
  EXPECT_EQ(back.outline, extent.outline);
  EXPECT_EQ(back.holes, extent.holes);
}

}  // namespace
}  // namespace mrpt_sgraphs
