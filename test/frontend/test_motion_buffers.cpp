// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/motion_buffers.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kStart_s = 1.7e9;  // as of today: doubles have some 0.2 us left
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Pose poseOf(const Eigen::Vector3d& t, const Eigen::Vector3d& theta) {
  Tangent delta;
  delta << t, theta;
  return expPose(delta);
}

/// A robot that goes straight and turns steadily.
Pose steadily(double time_s) {
  return poseOf({1.0, 2.0, 0.5}, {0.3, -0.2, 1.0}) *
         poseOf(Eigen::Vector3d::Zero(), time_s * Eigen::Vector3d(0.1, 0.05, 0.8));
}
Pose T_odom_base(double time_s) {
  Pose T = steadily(time_s);
  T.translation() += time_s * Eigen::Vector3d(0.9, -0.3, 0.1);
  return T;
}

OdomSample odomAt(double time_s) { return {kStart_s + time_s, T_odom_base(time_s)}; }

TEST(OdomBuffer, TellsTheMotionBetweenAnyTwoStamps) {
  test::RandomGeometry random(1, 100.0);
  const Pose T_other_odom = random.pose();
  OdomBuffer buffer;
  OdomBuffer elsewhere;
  for (int k = 0; k <= 100; ++k) {
    OdomSample sample = odomAt(0.05 * k);
    EXPECT_TRUE(buffer.add(sample));
    sample.T_odom_base = T_other_odom * sample.T_odom_base;
    EXPECT_TRUE(elsewhere.add(sample));
  }
  for (int trial = 0; trial < 200; ++trial) {
    const double from_s = 2.5 + random.number(2.5);
    const double to_s = 2.5 + random.number(2.5);
    SCOPED_TRACE(testing::Message() << from_s << " to " << to_s);
    const auto T_from_to = buffer.motion(kStart_s + from_s, kStart_s + to_s);
    ASSERT_TRUE(T_from_to);
    const Pose expected = T_odom_base(from_s).inverse() * T_odom_base(to_s);
    EXPECT_LT(local(expected, *T_from_to).norm(), 2e-6);
    const auto there = elsewhere.motion(kStart_s + from_s, kStart_s + to_s);
    ASSERT_TRUE(there);
    EXPECT_LT(local(*there, *T_from_to).norm(), 1e-9) << "depends on where odom is";
  }
}

TEST(OdomBuffer, ReachesALittleBeyondItsEnds) {
  OdomBuffer buffer;
  for (int k = 0; k <= 20; ++k) buffer.add(odomAt(0.05 * k));
  const Pose all = T_odom_base(0.0).inverse() * T_odom_base(1.0);
  const auto beyond = buffer.motion(kStart_s - 0.09, kStart_s + 1.09);
  ASSERT_TRUE(beyond);
  EXPECT_LT(local(all, *beyond).norm(), 1e-6);
  EXPECT_FALSE(buffer.motion(kStart_s - 0.11, kStart_s + 0.5));
  EXPECT_FALSE(buffer.motion(kStart_s + 0.5, kStart_s + 1.11));
  EXPECT_FALSE(OdomBuffer().motion(kStart_s, kStart_s));
}

TEST(OdomBuffer, RefusesWhatIsOutOfOrderOrNotFinite) {
  OdomBuffer buffer;
  EXPECT_TRUE(buffer.add(odomAt(0.0)));
  EXPECT_TRUE(buffer.add(odomAt(0.5)));
  OdomSample wrong{kStart_s + 0.5, poseOf({50.0, 0.0, 0.0}, {0.0, 0.0, 0.0})};
  EXPECT_FALSE(buffer.add(wrong)) << "the same stamp";
  wrong.stamp_s = kStart_s + 0.2;
  EXPECT_FALSE(buffer.add(wrong)) << "an earlier one";
  wrong.stamp_s = kNaN;
  EXPECT_FALSE(buffer.add(wrong));
  wrong = odomAt(0.7);
  wrong.T_odom_base.translation().y() = kNaN;
  EXPECT_FALSE(buffer.add(wrong));
  EXPECT_TRUE(buffer.add(odomAt(1.0)));
  const auto motion = buffer.motion(kStart_s + 0.2, kStart_s + 0.7);
  ASSERT_TRUE(motion);
  EXPECT_LT(local(T_odom_base(0.2).inverse() * T_odom_base(0.7), *motion).norm(), 1e-6);
}

TEST(OdomBuffer, DoesNotGuessAcrossALongHole) {
  OdomBuffer buffer;
  for (const double time_s : {0.0, 0.5, 1.4, 2.6, 3.0}) buffer.add(odomAt(time_s));
  EXPECT_TRUE(buffer.motion(kStart_s + 0.2, kStart_s + 1.0)) << "0.9 s may be bridged";
  EXPECT_FALSE(buffer.motion(kStart_s + 1.0, kStart_s + 2.0)) << "1.2 s may not";
  EXPECT_TRUE(buffer.motion(kStart_s + 1.0, kStart_s + 2.8)) << "but its ends are known";
}

TEST(OdomBuffer, RemembersSecondsNotHours) {
  OdomBuffer buffer;
  for (int k = 0; k <= 400; ++k) buffer.add(odomAt(0.1 * k));
  EXPECT_TRUE(buffer.motion(kStart_s + 30.0, kStart_s + 40.0));
  EXPECT_FALSE(buffer.motion(kStart_s + 20.0, kStart_s + 40.0));
}

ImuSample imuAt(double time_s, const Eigen::Vector3d& rate) {
  return {kStart_s + time_s, rate, {0.0, 0.0, 9.80665}};
}

TEST(ImuBuffer, IntegratesAConstantRate) {
  const Eigen::Vector3d rate(0.4, -0.7, 1.5);
  ImuBuffer buffer;
  for (int k = 0; k <= 500; ++k) buffer.add(imuAt(0.01 * k, rate));
  test::RandomGeometry random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const double from_s = 2.5 + random.number(2.5);
    const double to_s = 2.5 + random.number(2.5);  // earlier or later
    const auto R = buffer.rotation(kStart_s + from_s, kStart_s + to_s);
    ASSERT_TRUE(R);
    EXPECT_LT(logSO3(R->transpose() * expSO3((to_s - from_s) * rate)).norm(), 2e-6);
  }
}

TEST(ImuBuffer, IntegratesARateThatChanges) {
  // a gait: the angle about one axis is 0.1 sin(2 pi t)
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  const auto angle = [](double time_s) { return 0.1 * std::sin(2.0 * M_PI * time_s); };
  ImuBuffer buffer;
  for (int k = 0; k <= 500; ++k) {
    const double time_s = 0.01 * k;
    buffer.add(imuAt(time_s, 0.2 * M_PI * std::cos(2.0 * M_PI * time_s) * axis));
  }
  test::RandomGeometry random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const double from_s = 2.5 + random.number(2.5);
    const double to_s = 2.5 + random.number(2.5);
    const auto R = buffer.rotation(kStart_s + from_s, kStart_s + to_s);
    ASSERT_TRUE(R);
    EXPECT_LT((logSO3(*R) - (angle(to_s) - angle(from_s)) * axis).norm(), 2e-4);
  }
}

TEST(ImuBuffer, RotationsChain) {
  test::RandomGeometry random(4);
  ImuBuffer buffer;
  for (int k = 0; k <= 500; ++k) buffer.add(imuAt(0.01 * k, random.vector(3.0)));
  for (int trial = 0; trial < 200; ++trial) {
    const double a_s = kStart_s + 2.5 + random.number(2.5);
    const double b_s = kStart_s + 2.5 + random.number(2.5);
    const double c_s = kStart_s + 2.5 + random.number(2.5);
    const Eigen::Matrix3d chained = *buffer.rotation(a_s, b_s) * *buffer.rotation(b_s, c_s);
    EXPECT_LT(logSO3(chained.transpose() * *buffer.rotation(a_s, c_s)).norm(), 1e-9);
  }
}

TEST(ImuBuffer, HasNothingToSayOfHoles) {
  const Eigen::Vector3d rate(0.0, 0.0, 1.0);
  ImuBuffer buffer;
  for (int k = 0; k <= 300; ++k) {
    if (k <= 100 || k >= 110) buffer.add(imuAt(0.01 * k, rate));  // 0.1 s are missing from 1.0 on
  }
  EXPECT_TRUE(buffer.rotation(kStart_s + 0.5, kStart_s + 1.0));
  EXPECT_FALSE(buffer.rotation(kStart_s + 0.5, kStart_s + 1.2));
  EXPECT_FALSE(buffer.rotation(kStart_s + 1.2, kStart_s + 0.5)) << "backwards";
  EXPECT_TRUE(buffer.rotation(kStart_s + 1.1, kStart_s + 2.0));
  EXPECT_TRUE(buffer.rotation(kStart_s + 2.0, kStart_s + 3.04)) << "just past the end";
  EXPECT_FALSE(buffer.rotation(kStart_s + 2.0, kStart_s + 3.06));
  EXPECT_TRUE(buffer.rotation(kStart_s - 0.04, kStart_s + 0.5)) << "just before the start";
  EXPECT_FALSE(buffer.rotation(kStart_s - 0.06, kStart_s + 0.5));
  EXPECT_FALSE(ImuBuffer().rotation(kStart_s, kStart_s + 0.01));
}

TEST(ImuBuffer, RefusesWhatIsOutOfOrderOrNotFinite) {
  ImuBuffer buffer;
  EXPECT_TRUE(buffer.add(imuAt(0.0, Eigen::Vector3d::Zero())));
  EXPECT_FALSE(buffer.add(imuAt(0.0, Eigen::Vector3d::Zero())));
  EXPECT_FALSE(buffer.add(imuAt(-0.1, Eigen::Vector3d::Zero())));
  EXPECT_FALSE(buffer.add(imuAt(kNaN, Eigen::Vector3d::Zero())));
  EXPECT_FALSE(buffer.add(imuAt(0.1, {0.0, kNaN, 0.0})));
  ImuSample without_force = imuAt(0.1, Eigen::Vector3d::Zero());
  without_force.specific_force_base.z() = kNaN;
  EXPECT_FALSE(buffer.add(without_force));
  EXPECT_TRUE(buffer.add(imuAt(0.1, Eigen::Vector3d::Zero())));
}

TEST(ImuBuffer, LearnsItsBiasFromWhatTheScansSay) {
  const Eigen::Vector3d rate(0.1, 0.0, 0.5);
  const Eigen::Vector3d bias(0.02, -0.01, 0.03);
  ImuBuffer buffer;
  for (int k = 0; k <= 1000; ++k) buffer.add(imuAt(0.01 * k, rate + bias));
  const auto excess = [&](double at_s) -> Eigen::Vector3d {
    return logSO3(*buffer.rotation(kStart_s + at_s, kStart_s + at_s + 0.1)) / 0.1 - rate;
  };
  const double before = excess(1.0).norm();
  EXPECT_NEAR(before, bias.norm(), 1e-5);
  buffer.correctBias(excess(1.0));
  EXPECT_GT(excess(1.0).norm(), 0.9 * before) << "one scan does not decide it";
  for (int scan = 0; scan < 300; ++scan) buffer.correctBias(excess(1.0 + 0.02 * scan));
  EXPECT_LT(excess(5.0).norm(), 0.01 * before);
}

TEST(ImuBuffer, LevelsByGravity) {
  test::RandomGeometry random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Matrix3d R_level_base =
        expSO3({random.number(0.9), random.number(0.9), 0.0});  // tilted, not turned
    ImuBuffer buffer;
    for (int k = 0; k <= 100; ++k) {
      const Eigen::Vector3d up(0.0, 0.0, 9.80665);
      buffer.add({kStart_s + 0.01 * k, Eigen::Vector3d::Zero(),
                  R_level_base.transpose() * up + random.vector(0.05)});
    }
    const auto R = buffer.level(kStart_s, kStart_s + 1.0);
    ASSERT_TRUE(R);
    EXPECT_LT(logSO3(R->transpose() * R_level_base).norm(), 0.002);
  }
}

TEST(ImuBuffer, DoesNotLevelByOtherForces) {
  const auto levelOf = [](const Eigen::Vector3d& force, int samples) {
    ImuBuffer buffer;
    for (int k = 0; k < samples; ++k) {
      buffer.add({kStart_s + 0.01 * k, Eigen::Vector3d::Zero(), force});
    }
    return buffer.level(kStart_s, kStart_s + 1.0);
  };
  EXPECT_TRUE(levelOf({0.0, 0.0, 9.8}, 50));
  EXPECT_FALSE(levelOf({0.0, 0.0, 9.8}, 9)) << "too few";
  EXPECT_FALSE(levelOf({0.0, 0.0, 1.0}, 50)) << "in g";
  EXPECT_FALSE(levelOf({0.0, 0.0, 0.0}, 50)) << "no accelerometer";
  EXPECT_FALSE(levelOf({8.0, 0.0, 9.8}, 50)) << "falling about";
}

TEST(ImuBuffer, LevelsByTheTimeItIsAskedFor) {
  ImuBuffer buffer;
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d force =
        k < 100 ? Eigen::Vector3d(0.0, 0.0, 9.8) : Eigen::Vector3d(0.0, 5.0, 8.4);
    buffer.add({kStart_s + 0.01 * k, Eigen::Vector3d::Zero(), force});
  }
  EXPECT_LT(logSO3(*buffer.level(kStart_s, kStart_s + 0.985)).norm(), 1e-9);
  EXPECT_GT(logSO3(*buffer.level(kStart_s + 1.0, kStart_s + 2.0)).norm(), 0.5);
  EXPECT_FALSE(buffer.level(kStart_s + 5.0, kStart_s + 6.0));
}

}  // namespace
}  // namespace mrpt_sgraphs
