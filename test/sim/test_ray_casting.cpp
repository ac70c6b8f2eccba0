// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>

#include "sim/bvh.h"
#include "sim/random.h"
#include "sim/scene.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kExact_m = 1e-9;
constexpr double kFar_m = 100.0;

Ray ray(const Eigen::Vector3d& from, const Eigen::Vector3d& towards) {
  return {from, (towards - from).normalized()};
}

class TwoRooms : public ::testing::Test {
 protected:
  /// The range along the ray; negative if nothing comes back.
  double range(const Eigen::Vector3d& from, const Eigen::Vector3d& towards) const {
    const auto hit = scene_.cast(ray(from, towards), kFar_m, {});
    return hit && hit->material.returns ? hit->range_m : -1.0;
  }

  const Scene scene_{test::buildingFrom(test::kTwoRooms)};
};

TEST_F(TwoRooms, RayMeetsTheWallBesideTheDoorAndTheFarWallThroughIt) {
  EXPECT_NEAR(range({1.0, 1.0, 1.0}, {9.0, 1.0, 1.0}), 4.0, kExact_m);
  EXPECT_NEAR(range({1.0, 2.0, 1.0}, {9.0, 2.0, 1.0}), 8.0, kExact_m);
  EXPECT_NEAR(range({1.0, 2.49, 1.0}, {9.0, 2.49, 1.0}), 8.0, kExact_m);
  EXPECT_NEAR(range({1.0, 2.51, 1.0}, {9.0, 2.51, 1.0}), 4.0, kExact_m);
}

TEST_F(TwoRooms, DoorHasLintelJambsAndThreshold) {
  EXPECT_NEAR(range({1.0, 2.0, 2.1}, {9.0, 2.0, 2.1}), 4.0, kExact_m);
  EXPECT_NEAR(range({5.1, 2.0, 1.0}, {5.1, 9.0, 1.0}), 0.5, kExact_m);
  EXPECT_NEAR(range({5.1, 2.0, 1.0}, {5.1, -9.0, 1.0}), 0.5, kExact_m);
  EXPECT_NEAR(range({5.1, 2.0, 1.0}, {5.1, 2.0, 9.0}), 1.0, kExact_m);
  EXPECT_NEAR(range({5.1, 2.0, 1.0}, {5.1, 2.0, -9.0}), 1.0, kExact_m);
}

TEST_F(TwoRooms, WindowSwallowsTheRayAndItsWallDoesNot) {
  EXPECT_LT(range({2.0, 3.0, 1.5}, {-9.0, 3.0, 1.5}), 0.0);
  EXPECT_NEAR(range({2.0, 3.0, 0.9}, {-9.0, 3.0, 0.9}), 2.0, kExact_m);
  EXPECT_NEAR(range({2.0, 3.0, 2.1}, {-9.0, 3.0, 2.1}), 2.0, kExact_m);
}

TEST_F(TwoRooms, FloorAndCeilingCloseTheRoom) {
  EXPECT_NEAR(range({2.0, 1.0, 1.0}, {2.0, 1.0, -9.0}), 1.0, kExact_m);
  EXPECT_NEAR(range({2.0, 1.0, 1.0}, {2.0, 1.0, 9.0}), 2.0, kExact_m);
}

TEST(Shapes, BoxIsMetOnItsTurnedFace) {
  const Box box({3.0, 0.0}, {2.0, 2.0}, M_PI / 4.0, 0.0, 1.0, {});
  Hit hit;
  hit.range_m = kFar_m;
  ASSERT_TRUE(box.intersect(ray({0.0, 0.1, 0.5}, {3.0, 0.1, 0.5}), hit));
  EXPECT_NEAR(hit.range_m, 3.0 - std::sqrt(2.0) + 0.1, kExact_m);
  EXPECT_NEAR(std::abs(hit.normal.dot(Eigen::Vector3d::UnitX())), std::sqrt(0.5), kExact_m);
  hit.range_m = kFar_m;
  EXPECT_FALSE(box.intersect(ray({0.0, 0.0, 1.1}, {3.0, 0.0, 1.1}), hit));
}

TEST(Shapes, CylinderIsMetOnMantleAndLid) {
  const Cylinder cylinder({3.0, 0.0}, 0.5, 0.0, 1.0, {});
  Hit hit;
  hit.range_m = kFar_m;
  ASSERT_TRUE(cylinder.intersect(ray({0.0, 0.0, 0.5}, {3.0, 0.0, 0.5}), hit));
  EXPECT_NEAR(hit.range_m, 2.5, kExact_m);
  hit.range_m = kFar_m;
  ASSERT_TRUE(cylinder.intersect(ray({0.0, 0.0, 4.0}, {3.0, 0.0, 1.0}), hit));
  EXPECT_NEAR(hit.range_m, std::sqrt(18.0), kExact_m);
  hit.range_m = kFar_m;
  EXPECT_FALSE(cylinder.intersect(ray({0.0, 0.0, 1.5}, {3.0, 0.0, 1.5}), hit));
  EXPECT_FALSE(cylinder.intersect(ray({0.0, 0.6, 0.5}, {3.0, 0.6, 0.5}), hit));
}

TEST(Bvh, FindsWhatLookingAtEveryShapeFinds) {
  const std::vector<Shape> shapes = stillShapes(test::shipped("office"));
  const Bvh tree(shapes);
  Random random(7, Random::Stream::kLidar);
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(trial);
    const Eigen::Vector3d from(42.0 * random.uniform(), 26.0 * random.uniform(),
                               2.8 * random.uniform());
    const Eigen::Vector3d way(random.gaussian(), random.gaussian(), 0.3 * random.gaussian());
    const Ray ray{from, way.normalized()};
    Hit nearest;
    nearest.range_m = kFar_m;
    bool met = false;
    for (const Shape& shape : shapes) {
      met = std::visit([&](const auto& s) { return s.intersect(ray, nearest); }, shape) || met;
    }
    const auto hit = tree.cast(ray, kFar_m);
    ASSERT_EQ(hit.has_value(), met);
    if (hit) {
      EXPECT_EQ(hit->range_m, nearest.range_m);
    }
  }
}

TEST(Scene, PeopleWalkToAndFroAndStepAside) {
  const Scene scene(test::buildingFrom(test::replaced(
      test::kTwoRooms,
      "tour:", "    people:\n      - {from: [1.0, 1.0], to: [4.0, 1.0], speed_m_s: 1.0}\ntour:")));
  const Eigen::Vector3d robot_away(8.0, 3.0, 0.35);
  const auto rangeAt = [&](double time_s, const Eigen::Vector3d& robot_map) {
    const auto hit = scene.cast(ray({4.9, 1.0, 1.0}, {0.0, 1.0, 1.0}), kFar_m,
                                scene.peopleAt(time_s, robot_map));
    return hit->range_m;
  };
  EXPECT_NEAR(rangeAt(0.0, robot_away), 3.9 - 0.25, kExact_m);
  EXPECT_NEAR(rangeAt(2.0, robot_away), 1.9 - 0.25, kExact_m);
  EXPECT_NEAR(rangeAt(5.0, robot_away), 2.9 - 0.25, kExact_m);        // on the way back
  EXPECT_NEAR(rangeAt(2.0, {3.2, 1.0, 0.35}), 2.6 - 0.25, kExact_m);  // 0.2 m from the robot
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
