// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/plane_observer.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kWallX_m = 3.0;
constexpr double kHeight_m = 2.0;

Pose at(double x, double y) { return Pose(Eigen::Translation3d(x, y, 0.0)); }

/// What a robot at T_odom_base sees of the wall x = kWallX_m of odom, from y = from to y = to.
Cloud::ConstPtr scanOfWall(const Pose& T_odom_base, double from_m, double to_m) {
  constexpr double kStep_m = 0.05;
  Cloud::Ptr cloud(new Cloud);
  for (double y = from_m; y <= to_m; y += kStep_m) {
    for (double z = 0.0; z <= kHeight_m; z += kStep_m) {
      Point point;
      point.getVector3fMap() =
          (T_odom_base.inverse() * Eigen::Vector3d(kWallX_m, y, z)).cast<float>();
      cloud->push_back(point);
    }
  }
  return cloud;
}

class PlaneObserverTest : public ::testing::Test {
 protected:
  void add(const Pose& T_odom_base, double from_m, double to_m, bool registered = true) {
    observer_.addScan(scanOfWall(T_odom_base, from_m, to_m), T_odom_base, registered);
  }

  /// Where the one plane lies that it sees, and how wide it is.
  void expectWall(double distance_m, double width_m) {
    const ObservedPlanesConstPtr planes = observer_.take();
    ASSERT_NE(planes, nullptr);
    ASSERT_EQ(planes->size(), 1U);
    const ObservedPlane& wall = planes->front();
    EXPECT_NEAR(wall.plane_base.normal.x(), -1.0, 1e-6) << "it was seen from there";
    EXPECT_NEAR(wall.plane_base.distance, -distance_m, 1e-4);
    EXPECT_NEAR(wall.area_m2, width_m * kHeight_m, 0.15 * width_m * kHeight_m);
  }

  PlaneObserver observer_{PlaneSegmentationConfig{}};
};

TEST_F(PlaneObserverTest, TakesTheScansSinceTheLastKeyframeInTheBaseOfTheLastOne) {
  add(at(0.0, 0.0), -2.0, 0.0);
  add(at(0.5, 0.0), 0.0, 2.0);
  expectWall(2.5, 4.0);
  add(at(1.0, 0.0), 1.0, 2.0);
  expectWall(2.0, 1.0);
}

TEST_F(PlaneObserverTest, ForgetsWhatLiesBeforeAPoseThatWasNotMeasured) {
  add(at(0.0, 0.0), -2.0, 0.0);
  add(at(0.5, 0.0), 0.0, 2.0, false);
  add(at(1.0, 0.0), 0.0, 1.0);
  expectWall(2.0, 1.0);
}

TEST_F(PlaneObserverTest, KnowsNothingOfAKeyframeWhosePoseWasNotMeasured) {
  add(at(0.0, 0.0), -2.0, 0.0);
  add(at(0.5, 0.0), 0.0, 2.0, false);
  EXPECT_EQ(observer_.take(), nullptr);
}

TEST_F(PlaneObserverTest, GivesEachScanOnce) {
  EXPECT_EQ(observer_.take(), nullptr);
  add(at(0.0, 0.0), -2.0, 0.0);
  EXPECT_NE(observer_.take(), nullptr);
  EXPECT_EQ(observer_.take(), nullptr);
  add(at(0.0, 0.0), -2.0, 0.0);
  observer_.reset();
  EXPECT_EQ(observer_.take(), nullptr);
}

TEST_F(PlaneObserverTest, AKeyframeThatSeesNoPlaneHasAnEmptyList) {
  observer_.addScan(Cloud::Ptr(new Cloud), at(0.0, 0.0), true);
  const ObservedPlanesConstPtr planes = observer_.take();
  ASSERT_NE(planes, nullptr);
  EXPECT_TRUE(planes->empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
