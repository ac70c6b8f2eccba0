// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulation.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

/// A building turned by some degrees with the walk in it, and the same not turned. On wheels, since
/// the phase of a gait depends on the time.
class TurnedWalk : public ::testing::TestWithParam<double> {
 protected:
  static SimulationConfig config(double turn_rad) {
    SimulationConfig config;
    config.lidar = lidarNamed("vlp16_sparse");
    config.robot = robotNamed("wheeled");
    config.turn_rad = turn_rad;
    return config;
  }
  double yawAt(const Simulation& simulation, double time_s) const {
    const Eigen::Vector3d ahead = simulation.trajectory().T_map_base(time_s).linear().col(0);
    return std::atan2(ahead.y(), ahead.x());
  }
  /// Everything comes as much later as turning on the spot takes: a quintic step, whose peak is
  /// 1.875 times its mean, between two breaths.
  double delay_s() const {
    return 1.875 * std::abs(turn_rad_) / MotionLimits{}.turning_rad_s + 2.0 * 0.2;
  }

  const double turn_rad_ = GetParam() * M_PI / 180.0;
  const Building building_ = test::shipped("skewed");
  const Simulation straight_{building_, config(0.0)};
  const Simulation turned_{building_, config(turn_rad_)};
};
INSTANTIATE_TEST_SUITE_P(Degrees, TurnedWalk, ::testing::Values(17.0, 45.0, -90.0));

TEST_P(TurnedWalk, IsInTheTurnedBuilding) {
  EXPECT_NEAR(turned_.building().rotation_rad - building_.rotation_rad, turn_rad_, 1e-12);
  const Eigen::Rotation2Dd turn(turn_rad_);
  for (size_t k = 0; k < building_.rooms.size(); ++k) {
    const Eigen::Vector2d& corner = building_.rooms[k].outline[1];
    EXPECT_NEAR((turned_.building().rooms[k].outline[1] - turn * corner).norm(), 0.0, 1e-12);
  }
}

TEST_P(TurnedWalk, StartsWithTheHeadingOfTheOther) {
  EXPECT_NEAR(yawAt(turned_, 0.0), yawAt(straight_, 0.0), 1e-9);
  EXPECT_NEAR(turned_.trajectory().duration_s() - straight_.trajectory().duration_s(), delay_s(),
              2.0 * kMotionPeriod_s);
}

TEST_P(TurnedWalk, GoesTheSameWayThen) {
  const Pose T_turned_straight(Eigen::AngleAxisd(turn_rad_, Eigen::Vector3d::UnitZ()));
  // The motion is sampled at other moments, between which it turns by up to 0.13 rad.
  constexpr double kSampling_m = 0.02;
  constexpr double kSampling_rad = 0.1;
  for (double time_s = 0.0; time_s < straight_.trajectory().duration_s(); time_s += 0.37) {
    const Pose expected = T_turned_straight * straight_.trajectory().T_map_base(time_s);
    const Pose T_map_base = turned_.trajectory().T_map_base(time_s + delay_s());
    const Tangent difference = local(T_map_base, expected);
    ASSERT_NEAR(difference.head<3>().norm(), 0.0, kSampling_m) << time_s;
    const bool still_turning = time_s < MotionLimits{}.still_s;
    if (still_turning) continue;
    ASSERT_NEAR(difference.tail<3>().norm(), 0.0, kSampling_rad) << time_s;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
