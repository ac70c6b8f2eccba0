// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/scan_matcher.h"

#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/motion_model.h"
#include "mrpt_sgraphs/frontend/sweep.h"
#include "support/random_geometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

/// The west room of the small building, mapped from its middle, off the grid of the map's cells.
class ScanMatcherTest : public ::testing::Test {
 protected:
  ScanMatcherTest() {
    T_map_building_.translation() << 0.13, 0.21, 0.17;
    for (std::uint64_t k = 1; k <= 4; ++k) {
      const test::PlacedScan scan =
          stage_.scan({{1.6 + 0.3 * double(k), 4.4 - 0.1 * double(k)}, 0.5 * double(k)}, k);
      const Pose T_map_base = T_map_building_ * scan.T_map_base;
      for (const Point& point : *scan.cloud) {
        map_.insert(T_map_base * point.getVector3fMap().cast<double>(), T_map_base * viewpoint_);
      }
    }
    map_.refit();
  }

  /// A scan with no motion in it.
  std::vector<ScanPoint> points(const Cloud& cloud) const {
    const Cloud::Ptr still = test::withoutTimes(cloud);
    return Sweep(*still, {}).pointsToRegister(2500);
  }

  RegistrationResult match(const test::PlacedScan& scan, const MotionPrior& prior) const {
    return ScanMatcher({}).match(points(*scan.cloud), map_, prior, viewpoint_);
  }

  double error(const test::PlacedScan& scan, const RegistrationResult& fit) const {
    return local(T_map_building_ * scan.T_map_base, fit.estimate.T_map_base).norm();
  }

  const test::ScanStage stage_{sim::test::shipped("small"), sim::lidarNamed("vlp16")};
  const Eigen::Vector3d viewpoint_ = stage_.T_base_lidar().translation();
  Pose T_map_building_ = Pose::Identity();
  VoxelMap map_{VoxelMapConfig{}};
};

TEST_F(ScanMatcherTest, FindsAScanWherePredicted) {
  const test::PlacedScan scan = stage_.scan({{2.5, 4.3}, 1.0}, 50);
  const MotionState state = startingMotion(0.0, T_map_building_ * scan.T_map_base);
  const RegistrationResult fit =
      match(scan, predictMotion(state, 0.1, false, {}, {}, MotionModelConfig{}));
  EXPECT_TRUE(isTrustworthy(fit));
  EXPECT_LT(error(scan, fit), 0.02);
}

TEST_F(ScanMatcherTest, SearchesHeadingsWhenThePredictionKnowsLittle) {
  test::RandomGeometry random(2);
  for (const double turn_rad : {-0.6, -0.4, 0.4, 0.6}) {
    const test::PlacedScan scan = stage_.scan({{2.5, 4.3}, 1.0}, 50);
    Pose T_map_guess = T_map_building_ * scan.T_map_base *
                       Pose(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
    T_map_guess.translation() += Eigen::Vector3d(random.number(0.3), random.number(0.3), 0.0);
    const RegistrationResult fit = match(scan, ignorantAround({T_map_guess}));
    EXPECT_TRUE(isTrustworthy(fit));
    EXPECT_LT(error(scan, fit), 0.03) << turn_rad;
  }
}

TEST_F(ScanMatcherTest, DoesNotTrustAScanFromElsewhere) {
  const test::PlacedScan corridor = stage_.scan({{7.5, 1.0}, 0.3}, 60);
  const test::PlacedScan room = stage_.scan({{2.5, 4.3}, 1.0}, 50);
  const RegistrationResult fit =
      match(corridor, ignorantAround({T_map_building_ * room.T_map_base}));
  EXPECT_FALSE(isTrustworthy(fit)) << fit.inlier_ratio << " " << fit.consistency;
}

TEST(ScanMatcher, TrustsOnlyWhatLiesOnTheMap) {
  RegistrationResult fit;
  fit.matched = 500;
  fit.inlier_ratio = 0.5;
  fit.consistency = 0.9;
  EXPECT_TRUE(isTrustworthy(fit));
  fit.inlier_ratio = 0.05;
  EXPECT_FALSE(isTrustworthy(fit)) << "few points have a plane";
  fit.inlier_ratio = 0.5;
  fit.consistency = 0.2;
  EXPECT_FALSE(isTrustworthy(fit)) << "many do not lie on theirs";
  EXPECT_FALSE(isTrustworthy({}));
}

}  // namespace
}  // namespace mrpt_sgraphs
