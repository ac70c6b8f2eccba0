// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "semantics/plan_search.h"

namespace mrpt_sgraphs {
namespace {

/// What a lidar at the height of the slab sees from the middle of a rectangle, of all around it.
void seeRectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, FreeSpace* space) {
  Cloud cloud;
  const Eigen::Vector2d middle = 0.5 * (low + high);
  constexpr int kRays = 720;
  for (int ray = 0; ray < kRays; ++ray) {
    const double angle = 2.0 * M_PI * ray / kRays;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const Eigen::Array2d to_border = (0.5 * (high - low)).array() / direction.array().abs();
    const Eigen::Vector2d hit = to_border.minCoeff() * direction;
    Point point;
    point.getVector3fMap() << hit.cast<float>(), 0.0F;
    cloud.push_back(point);
  }
  Pose T_floor_base = Pose::Identity();
  T_floor_base.translation() << middle, 1.0;
  space->add(cloud, T_floor_base);
}

StoreyPlan planOf(const FreeSpace& space) { return StoreyPlan(space, {0.4, 1.9}, {}, {}); }

/// A rectangle of 6 m x 4 m and, if wanted, the same again.
StoreyPlan known(bool twice) {
  FreeSpace space{FreeSpaceConfig{}};
  seeRectangle({0.0, 0.0}, {6.0, 4.0}, &space);
  if (twice) seeRectangle({0.0, 10.0}, {6.0, 14.0}, &space);
  seeRectangle({10.0, 0.0}, {13.0, 3.0}, &space);
  return planOf(space);
}

/// The rectangle from another place in it: its middle is at (1, 0.5), turned by 0.4 rad.
const Eigen::Isometry2d kTurn = Eigen::Translation2d(1.0, 0.5) * Eigen::Rotation2Dd(0.4);

std::vector<Eigen::Vector2d> seen() {
  FreeSpace space{FreeSpaceConfig{}};
  seeRectangle({-3.0, -2.0}, {3.0, 2.0}, &space);
  std::vector<Eigen::Vector2d> surfaces = planOf(space).surfaces();
  for (Eigen::Vector2d& surface : surfaces) surface = kTurn * surface;
  return surfaces;
}

TEST(PlanSearch, FindsEveryPlaceAtWhichARectangleFits) {
  const StoreyPlan once = known(false);
  const auto matches = PlanSearch(once).find(seen(), 0.5, 0.1, {});
  ASSERT_EQ(matches.size(), 2U);  // a rectangle looks the same turned by half a turn
  const StoreyPlan twice = known(true);
  EXPECT_EQ(PlanSearch(twice).find(seen(), 0.5, 0.1, {}).size(), 4U);
}

TEST(PlanSearch, RefinesToACellOfEitherPlan) {
  const StoreyPlan plan = known(false);
  const PlanSearch search(plan);
  for (const PlanMatch& match : search.find(seen(), 0.5, 0.1, {})) {
    const PlanMatch fine = search.refined(seen(), match);
    EXPECT_GE(fine.score, match.score - 1e-9);
    EXPECT_GT(fine.score, 0.8);
    const Eigen::Vector2d middle = fine.T_known_plan * Eigen::Vector2d(1.0, 0.5);
    EXPECT_NEAR((middle - Eigen::Vector2d(3.0, 2.0)).norm(), 0.0, 0.2);
    const double turn = Eigen::Rotation2Dd(0.0).fromRotationMatrix(fine.T_known_plan.linear()).angle();
    EXPECT_NEAR(std::remainder(turn + 0.4, M_PI), 0.0, 0.02);
  }
}

TEST(PlanSearch, AWindowLeavesOutWhatIsBeyondIt) {
  const StoreyPlan plan = known(true);
  const PlanSearch search(plan);
  Eigen::Isometry2d guess = Eigen::Isometry2d::Identity();
  guess.linear() = Eigen::Rotation2Dd(-0.3).toRotationMatrix();
  guess.translation() << 2.0, 12.0;
  const auto matches = search.find(seen(), 0.5, 0.1, {guess, 1.5, 0.5});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_GT(matches.front().T_known_plan.translation().y(), 10.0);
}

TEST(PlanSearch, WhatIsNowhereIsNotFound) {
  FreeSpace space{FreeSpaceConfig{}};
  seeRectangle({-5.0, -0.8}, {5.0, 0.8}, &space);
  const StoreyPlan plan = known(true);
  EXPECT_TRUE(PlanSearch(plan).find(planOf(space).surfaces(), 0.8, 0.2, {}).empty());
}

TEST(StoreyPlan, RaysThroughASurfaceSpeakAgainstIt) {
  FreeSpace space{FreeSpaceConfig{}};
  seeRectangle({0.0, 0.0}, {3.0, 3.0}, &space);  // stands in the middle of the larger one
  const StoreyPlan small = planOf(space);
  FreeSpace larger{FreeSpaceConfig{}};
  seeRectangle({-2.0, -2.0}, {5.0, 5.0}, &larger);
  const StoreyPlan large = planOf(larger);
  const PlanAgreement itself = compare(small, small, Eigen::Isometry2d::Identity());
  EXPECT_EQ(itself.against, 0);
  EXPECT_DOUBLE_EQ(itself.agreement(), 1.0);
  EXPECT_DOUBLE_EQ(itself.coverage(), 1.0);
  const PlanAgreement other = compare(large, small, Eigen::Isometry2d::Identity());
  EXPECT_EQ(other.found, 0);
  EXPECT_EQ(other.against, static_cast<int>(small.surfaces().size()));
  EXPECT_LT(other.balance(), 0);
}

}  // namespace
}  // namespace mrpt_sgraphs
