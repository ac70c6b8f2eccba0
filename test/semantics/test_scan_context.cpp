// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/semantics/scan_context.h"

#include <gtest/gtest.h>

#include "support/random_geometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSector_rad = 2.0 * M_PI / ScanContext::kSectors;

/// The same scan in another base frame.
Cloud::Ptr moved(const Pose& T_other_base, const Cloud& cloud) {
  Cloud::Ptr result(new Cloud(cloud));
  const Eigen::Isometry3f T = T_other_base.cast<float>();
  for (Point& point : *result) point.getVector3fMap() = T * point.getVector3fMap();
  result->sensor_origin_.head<3>() = T * Eigen::Vector3f(cloud.sensor_origin_.head<3>());
  return result;
}

Pose turnedBy(double yaw_rad) {
  return Pose(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

ScanContext contextOf(const Cloud& cloud) { return {cloud, Eigen::Matrix3d::Identity()}; }

class ScanContextTest : public ::testing::Test {
 protected:
  Cloud::Ptr scan(const Eigen::Vector2d& place_map, double yaw_rad = 0.0, int seed = 1) const {
    return stage_.scan({place_map, yaw_rad}, static_cast<std::uint64_t>(seed)).cloud;
  }

  const test::ScanStage stage_{sim::test::shipped("small"), sim::lidarNamed("vlp16")};
  const std::vector<Eigen::Vector2d> places_{{2.2, 4.2}, {7.0, 4.0}, {1.5, 1.0}, {6.0, 1.0}};
};

TEST_F(ScanContextTest, EveryPlaceIsLikeItself) {
  for (const Eigen::Vector2d& place : places_) {
    const ScanContext context = contextOf(*scan(place));
    const auto comparison = context.compare(context);
    EXPECT_NEAR(comparison.similarity, 1.0, 1e-5) << place.transpose();
    EXPECT_EQ(comparison.yaw_rad, 0.0);
  }
}

TEST_F(ScanContextTest, FindsTheTurnBetweenTwoVisits) {
  const Cloud::Ptr first = scan(places_[0]);
  for (int sectors = -35; sectors <= 36; ++sectors) {
    const double yaw_rad = sectors * kSector_rad;
    // T_first_second = turnedBy(yaw): what the first sees, the second sees turned back
    const Cloud::Ptr second = moved(turnedBy(yaw_rad).inverse(), *first);
    const auto comparison = contextOf(*first).compare(contextOf(*second));
    EXPECT_GT(comparison.similarity, 0.95) << sectors;
    EXPECT_LT(std::abs(std::remainder(comparison.yaw_rad - yaw_rad, 2.0 * M_PI)), 1e-6) << sectors;
    const auto reverse = contextOf(*second).compare(contextOf(*first));
    EXPECT_NEAR(reverse.similarity, comparison.similarity, 1e-5);
    EXPECT_LT(std::abs(std::remainder(reverse.yaw_rad + yaw_rad, 2.0 * M_PI)), 1e-6) << sectors;
  }
}

TEST_F(ScanContextTest, FindsTheTurnOfASecondScanToASector) {
  test::RandomGeometry random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const double yaw_rad = random.number(M_PI);
    const auto comparison =
        contextOf(*scan(places_[1], 0.0, 1)).compare(contextOf(*scan(places_[1], yaw_rad, 2)));
    EXPECT_GT(comparison.similarity, 0.6);
    EXPECT_LT(std::abs(std::remainder(comparison.yaw_rad - yaw_rad, 2.0 * M_PI)), kSector_rad);
  }
}

TEST_F(ScanContextTest, TheSamePlaceFromHalfAMetreAwayIsMoreAlikeThanAnotherKindOfPlace) {
  for (std::size_t here = 0; here < places_.size(); ++here) {
    const ScanContext context = contextOf(*scan(places_[here]));
    for (int k = 0; k < 8; ++k) {
      const double direction = 0.25 * M_PI * k;
      const Eigen::Vector2d near_by =
          places_[here] + 0.5 * Eigen::Vector2d(std::cos(direction), std::sin(direction));
      const double same = context.compare(contextOf(*scan(near_by, 0.7 * k, 2 + k))).similarity;
      for (std::size_t there = 0; there < places_.size(); ++there) {
        if ((here < 2) == (there < 2)) continue;  // the rooms are of one size, or one corridor
        EXPECT_GT(same, context.compare(contextOf(*scan(places_[there]))).similarity)
            << "place " << here << ", half a metre to " << direction << ", against " << there;
      }
    }
  }
}

TEST_F(ScanContextTest, DoesNotDependOnTheBaseFrame) {
  const Cloud::Ptr cloud = scan(places_[1]);
  test::RandomGeometry random(5, 3.0);
  for (int trial = 0; trial < 10; ++trial) {
    Pose T_other_base = random.smallPose(0.0, 0.3);
    T_other_base.translation() = random.vector(2.0);
    const ScanContext level(*moved(T_other_base, *cloud), T_other_base.linear().transpose());
    EXPECT_GT(contextOf(*cloud).compare(level).similarity, 0.97);
    EXPECT_EQ(contextOf(*cloud).compare(level).yaw_rad, 0.0);
  }
}

TEST_F(ScanContextTest, OfNothingIsLikeNothing) {
  const ScanContext nothing = contextOf(Cloud{});
  EXPECT_EQ(nothing.compare(nothing).similarity, 0.0);
  EXPECT_EQ(nothing.compare(contextOf(*scan(places_[0]))).similarity, 0.0);
}

}  // namespace
}  // namespace mrpt_sgraphs
