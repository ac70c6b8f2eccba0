// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/sweep.h"

#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/thinning.h"
#include "support/random_geometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

class SweepTest : public ::testing::Test {
 protected:
  SweepTest() {
    const test::ScanStage stage(sim::test::shipped("small"), sim::lidarNamed("vlp16"));
    scan_ = stage.scan({{2.2, 4.2}}).cloud;
  }

  /// A gyroscope that turns steadily while the scan is taken.
  ImuBuffer turning(const Eigen::Vector3d& rate) const {
    ImuBuffer imu;
    for (int k = -20; k <= 20; ++k) {
      imu.add({stampOf(*scan_) + 0.01 * k, rate, {0.0, 0.0, 9.81}});
    }
    return imu;
  }

  Cloud::Ptr scan_;
};

TEST_F(SweepTest, KnowsWhenItEnds) {
  const Sweep sweep(*scan_, {});
  EXPECT_TRUE(sweep.hasTimes());
  EXPECT_FALSE(sweep.hasTurning());
  EXPECT_NEAR(sweep.end_s(), stampOf(*scan_) + 0.1, 1e-3);
}

TEST_F(SweepTest, WithoutTimesChangesNothing) {
  const Cloud::Ptr still = test::withoutTimes(*scan_);
  const Sweep sweep(*still, turning({0.0, 0.0, 1.0}));
  EXPECT_FALSE(sweep.hasTimes());
  EXPECT_FALSE(sweep.hasTurning());
  EXPECT_EQ(sweep.end_s(), stampOf(*scan_));
  Tangent velocity;
  velocity << 1.0, 0.5, 0.0, 0.0, 0.0, 1.0;
  const Cloud::Ptr deskewed = sweep.deskewed(velocity);
  for (std::size_t i = 0; i < scan_->size(); ++i) {
    ASSERT_EQ((*deskewed)[i].getVector3fMap(), (*scan_)[i].getVector3fMap());
  }
  for (const ScanPoint& point : sweep.pointsToRegister(1000)) ASSERT_EQ(point.time_s, 0.0);
}

TEST_F(SweepTest, ThinsPointsOutInSpaceAndKeepsTheirTimes) {
  const Sweep sweep(*scan_, {});
  const auto all = sweep.pointsToRegister(1000000);
  constexpr double kVoxel_m = 0.15;
  EXPECT_EQ(all.size(), firstInVoxels(*scan_, kVoxel_m).size());
  for (const int most : {100, 500, 1000}) {
    const auto points = sweep.pointsToRegister(most);
    const auto expected = static_cast<double>(std::min<std::size_t>(all.size(), most));
    EXPECT_NEAR(static_cast<double>(points.size()), expected, 1.0);
    // from all of the sweep
    EXPECT_LT(points.front().time_s, 0.005);
    EXPECT_GT(points.back().time_s, 0.095);
  }
}

TEST_F(SweepTest, UndoesAKnownMotion) {
  Tangent velocity;
  velocity << 1.2, -0.5, 0.1, 0.1, -0.2, 1.5;
  const Cloud::Ptr deskewed = Sweep(*scan_, {}).deskewed(velocity);
  ASSERT_EQ(deskewed->size(), scan_->size());
  EXPECT_EQ(deskewed->header.stamp, scan_->header.stamp);
  for (std::size_t i = 0; i < scan_->size(); ++i) {
    const Point& point = (*scan_)[i];
    const Eigen::Vector3d expected =
        expSO3(point.time * velocity.tail<3>()) * point.getVector3fMap().cast<double>() +
        point.time * velocity.head<3>();
    ASSERT_LT(((*deskewed)[i].getVector3fMap().cast<double>() - expected).norm(), 1e-5);
    ASSERT_EQ((*deskewed)[i].time, 0.0F);
    ASSERT_EQ((*deskewed)[i].ring, point.ring);
  }
}

TEST_F(SweepTest, GyroscopeUndoesTheTurning) {
  const Eigen::Vector3d rate(0.2, -0.4, 2.0);
  const ImuBuffer imu = turning(rate);
  const Sweep sweep(*scan_, imu);
  ASSERT_TRUE(sweep.hasTurning());
  const auto straight = [&](const Point& point) -> Eigen::Vector3d {
    return expSO3(point.time * rate) * point.getVector3fMap().cast<double>();
  };
  const Cloud::Ptr deskewed = sweep.deskewed(Tangent::Zero());
  for (std::size_t i = 0; i < scan_->size(); ++i) {
    const Point& point = (*scan_)[i];
    // half a step of a hundred of the sweep
    const double tolerance_m = 6e-4 * rate.norm() * point.getVector3fMap().norm();
    ASSERT_LT(((*deskewed)[i].getVector3fMap().cast<double>() - straight(point)).norm(),
              tolerance_m);
  }
  const std::vector<ScanPoint> points = sweep.pointsToRegister(1000000);
  const std::vector<int> kept = firstInVoxels(*scan_, 0.15);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& point = (*scan_)[static_cast<std::size_t>(kept[k])];
    ASSERT_LT((points[k].position - straight(point)).norm(), 0.02);
  }
}

TEST_F(SweepTest, DoesWithoutAGyroscopeThatFallsSilent) {
  ImuBuffer imu;
  for (int k = -20; k <= 2; ++k) {
    imu.add({stampOf(*scan_) + 0.01 * k, {0.0, 0.0, 1.0}, {0.0, 0.0, 9.81}});
  }
  EXPECT_FALSE(Sweep(*scan_, imu).hasTurning());
}

TEST_F(SweepTest, TakesTimesBeforeTheStamp) {
  for (Point& point : *scan_) point.time -= 0.1F;
  const Sweep sweep(*scan_, turning({0.0, 0.0, 1.0}));
  EXPECT_TRUE(sweep.hasTimes());
  EXPECT_TRUE(sweep.hasTurning());
  EXPECT_NEAR(sweep.end_s(), stampOf(*scan_), 1e-3);
}

}  // namespace
}  // namespace mrpt_sgraphs
