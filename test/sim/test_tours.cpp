// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sim/floor_plan.h"
#include "sim/tour.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kStep_s = 0.02;

/// Walks every building that is shipped.
class ShippedBuilding : public ::testing::TestWithParam<const char*> {
 protected:
  /// Calls visit(time, T_map_base, storey) along the walk.
  template <typename Visit>
  void walk(const Visit& visit) const {
    for (double t = 0.0; t <= trajectory_.duration_s(); t += kStep_s) {
      const Pose T_map_base = trajectory_.T_map_base(t);
      const double floor_m = T_map_base.translation().z() - robot_.base_height_m;
      size_t storey = 0;
      for (size_t k = 0; k < building_.storeys.size(); ++k) {
        if (floor_m > building_.storeys[k].elevation_m - 0.2) storey = k;
      }
      visit(t, T_map_base, storey);
    }
  }

  const Building building_ = test::shipped(GetParam());
  const Robot robot_ = robotNamed("legged");
  const Trajectory trajectory_ = walkTour(building_, robot_);
};

TEST_P(ShippedBuilding, TourEntersEveryRoomItLists) {
  std::set<size_t> entered;
  walk([&](double, const Pose& T_map_base, size_t storey) {
    const auto room = building_.roomAt(storey, T_map_base.translation().head<2>());
    if (room) entered.insert(*room);
  });
  for (const TourStop& stop : building_.tour) {
    EXPECT_TRUE(entered.count(stop.room)) << building_.rooms[stop.room].name;
  }
}

TEST_P(ShippedBuilding, TourComesBackToWhereItWas) {
  const Eigen::Vector3d start = trajectory_.T_map_base(0.0).translation();
  const Eigen::Vector3d end = trajectory_.T_map_base(trajectory_.duration_s()).translation();
  EXPECT_LT((end - start).norm(), 3.0);
}

TEST_P(ShippedBuilding, RobotNeverTouchesWallsOrFurniture) {
  constexpr double kHalfWidth_m = 0.25;
  constexpr double kStairsApproach_m = 1.0;
  std::vector<FloorPlan> plans;
  for (size_t k = 0; k < building_.storeys.size(); ++k) plans.emplace_back(building_, k);
  walk([&](double t, const Pose& T_map_base, size_t storey) {
    const Eigen::Vector2d p = T_map_base.translation().head<2>();
    for (const Flight& flight : building_.flights) {
      if (distanceToSegment(p, flight.foot, flight.head()) < kStairsApproach_m) return;
    }
    ASSERT_GT(plans[storey].clearance(p), kHalfWidth_m) << "at " << t << " s: " << p.transpose();
  });
}

TEST_P(ShippedBuilding, MotionIsWithinLimitsAndSmooth) {
  const MotionLimits limits;
  // What the gait adds: 1 cm of sway at 0.9 Hz; 0.8, 1.0, 1.2 degrees of rotation; the bob.
  constexpr double kGaitSpeed_m_s = 0.08;
  constexpr double kGaitRate_rad_s = 0.35;
  constexpr double kGaitAcceleration_m_s2 = 2.5;
  // A spline of 0.15 s follows at most this change of acceleration, the bob included.
  constexpr double kJerk_m_s3 = 45.0;
  Eigen::Vector3d last = trajectory_.acceleration_map(0.0);
  walk([&](double t, const Pose&, size_t) {
    const Eigen::Vector3d acceleration = trajectory_.acceleration_map(t);
    ASSERT_LE(trajectory_.velocity_map(t).head<2>().norm(), limits.walking_m_s + kGaitSpeed_m_s);
    ASSERT_LE(trajectory_.angularVelocity_base(t).norm(), limits.turning_rad_s + kGaitRate_rad_s);
    ASSERT_LE(acceleration.norm(), kGaitAcceleration_m_s2);
    ASSERT_LE((acceleration - last).norm(), kJerk_m_s3 * kStep_s) << "at " << t << " s";
    last = acceleration;
  });
}

TEST_P(ShippedBuilding, StartsAndEndsAtRest) {
  constexpr double kRounding_m_s = 1e-9;
  for (double t = 0.0; t < 1.2; t += kStep_s) {
    EXPECT_LT(trajectory_.velocity_map(t).norm(), kRounding_m_s);
    EXPECT_LT(trajectory_.velocity_map(trajectory_.duration_s() - t).norm(), kRounding_m_s);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedBuilding,
                         ::testing::Values("small", "construction_c1f1", "construction_c1f2",
                                           "office", "campaign", "split_level", "two_stairs", "two_storey",
                                           "skewed"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Tour, IsWalkedAsOftenAsAsked) {
  const Building building = test::shipped("small");
  const std::size_t first = building.tour.front().room;
  int entered = 0;
  bool was_in = true;
  const Trajectory once = walkTour(building, robotNamed("legged"));
  const Trajectory thrice = walkTour(withTours(building, 3), robotNamed("legged"));
  for (double t = 0.0; t <= thrice.duration_s(); t += kStep_s) {
    const bool is_in =
        building.roomAt(0, thrice.T_map_base(t).translation().head<2>()) == std::optional(first);
    if (is_in && !was_in) ++entered;
    was_in = is_in;
  }
  EXPECT_GE(entered, 3);
  // and turns around between two of them
  EXPECT_GT(thrice.duration_s(), 3.0 * once.duration_s());
  EXPECT_LT(thrice.duration_s(), 3.3 * once.duration_s());
  const Pose T_start_end = once.T_map_base(0.0).inverse() * thrice.T_map_base(thrice.duration_s());
  EXPECT_LT(T_start_end.translation().norm(), 3.0);
}

TEST(Tour, GoesStraightThroughTheMiddleOfTheDoor) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Trajectory trajectory = walkTour(building, robotNamed("wheeled"));
  for (double t = 0.0; t < trajectory.duration_s(); t += kStep_s) {
    const Eigen::Vector3d p = trajectory.T_map_base(t).translation();
    if (p.x() < 5.0 || p.x() > 5.2) continue;
    EXPECT_NEAR(p.y(), 2.0, 0.01);
  }
}

TEST(Tour, RoundsCornersNoWiderThanFurnitureAllows) {
  // Between the given points there is room for the legs, but not for the widest arc.
  const std::string with_box = test::replaced(
      test::kTwoRooms, "tour:", "    furniture: [{at: [1.75, 2.2], size_m: [1.6, 1.5, 1]}]\ntour:");
  const Building building = test::buildingFrom(
      test::replaced(with_box, "[[1.5, 1.0]]", "[[0.8, 1.0], [3.0, 1.0], [3.0, 3.2]]"));
  const FloorPlan plan(building, 0);
  const Trajectory trajectory = walkTour(building, robotNamed("wheeled"));
  constexpr double kHalfWidth_m = 0.25;
  for (double t = 0.0; t < trajectory.duration_s(); t += kStep_s) {
    const Eigen::Vector2d p = trajectory.T_map_base(t).translation().head<2>();
    ASSERT_GT(plan.clearance(p), kHalfWidth_m) << p.transpose();
  }
}

TEST(Tour, ClimbsToTheUpperFloorAndLeansOnTheStairs) {
  const Building building = test::shipped("two_storey");
  const Robot robot = robotNamed("legged");
  const Trajectory trajectory = walkTour(building, robot);
  double highest_m = 0.0;
  double steepest_rad = 0.0;
  for (double t = 0.0; t < trajectory.duration_s(); t += kStep_s) {
    const Pose T_map_base = trajectory.T_map_base(t);
    highest_m = std::max(highest_m, T_map_base.translation().z());
    steepest_rad = std::max(steepest_rad, std::asin(T_map_base.linear()(2, 0)));
  }
  const double floor_m = building.storeys[1].elevation_m;
  EXPECT_NEAR(highest_m, floor_m + robot.base_height_m, 0.02);
  const Flight& flight = building.flights[0];
  EXPECT_NEAR(steepest_rad, robot.slope_pitch * std::atan(floor_m / flight.run_m), 0.03);
}

TEST(Tour, WheelsDoNotClimbStairs) {
  EXPECT_THROW(walkTour(test::shipped("two_storey"), robotNamed("wheeled")), std::invalid_argument);
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
