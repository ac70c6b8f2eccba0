// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/prefilter.h"

#include <gtest/gtest.h>

#include <limits>

#include "raw_cloud_builder.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using test::OwnedRawCloud;
using test::plainSweep;
using test::RawCloudBuilder;
using test::sweptPoint;
using Type = RawCloud::Type;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PrefilterResult filtered(const OwnedRawCloud& raw, const PrefilterConfig& config = {},
                         const Pose& T_base_lidar = Pose::Identity()) {
  return Prefilter(config).filter(raw.view(), T_base_lidar, "base_link");
}

/// When the points of plainSweep() were measured, from the start of the sweep [s].
double firedAt(std::size_t point) { return 1e-4 * static_cast<double>(point); }

struct TimeEncoding {
  const char* name;
  const char* field;
  Type type;
  double (*value)(double stamp_s, double fired_at_s);
  double first_s;      ///< The first point's time from the header stamp.
  double precision_s;  ///< Of the encoding itself.
};

std::ostream& operator<<(std::ostream& out, const TimeEncoding& encoding) {
  return out << encoding.name;
}

class PrefilterTimes : public ::testing::TestWithParam<TimeEncoding> {};

TEST_P(PrefilterTimes, BecomeSecondsFromTheStamp) {
  const TimeEncoding& encoding = GetParam();
  RawCloudBuilder builder = plainSweep();
  builder.field(encoding.field, encoding.type, [&](std::size_t point) {
    return encoding.value(builder.stamp_s, firedAt(point));
  });
  const PrefilterResult result = filtered(builder.build());
  ASSERT_EQ(result.problem, "");
  ASSERT_TRUE(result.has_time) << result.remark;
  for (std::size_t i = 0; i < result.cloud->size(); ++i) {
    ASSERT_NEAR((*result.cloud)[i].time, encoding.first_s + firedAt(i), encoding.precision_s) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Encodings, PrefilterTimes,
    ::testing::Values(
        TimeEncoding{"FloatSeconds", "time", Type::kFloat32,
                     [](double, double t) { return t; }, 0.0, 1e-7},
        TimeEncoding{"FloatMilliseconds", "time", Type::kFloat32,
                     [](double, double t) { return 1e3 * t; }, 0.0, 1e-7},
        TimeEncoding{"FloatMicroseconds", "time", Type::kFloat32,
                     [](double, double t) { return 1e6 * t; }, 0.0, 1e-7},
        TimeEncoding{"UnsignedNanoseconds", "t", Type::kUint32,
                     [](double, double t) { return 1e9 * t; }, 0.0, 1e-7},
        TimeEncoding{"UnsignedMicroseconds", "t", Type::kUint32,
                     [](double, double t) { return 1e6 * t; }, 0.0, 2e-6},
        TimeEncoding{"OffsetTimeNanoseconds", "offset_time", Type::kUint32,
                     [](double, double t) { return 1e9 * t; }, 0.0, 1e-7},
        TimeEncoding{"AbsoluteSeconds", "timestamp", Type::kFloat64,
                     [](double stamp, double t) { return stamp + t; }, 0.0, 1e-6},
        TimeEncoding{"AbsoluteMicroseconds", "timestamp", Type::kFloat64,
                     [](double stamp, double t) { return 1e6 * (stamp + t); }, 0.0, 2e-6},
        TimeEncoding{"AbsoluteNanoseconds", "timestamp", Type::kFloat64,
                     [](double stamp, double t) { return 1e9 * (stamp + t); }, 0.0, 2e-6},
        TimeEncoding{"StampAtTheEndFloat", "time", Type::kFloat32,
                     [](double, double t) { return t - 0.0999; }, -0.0999, 1e-7},
        TimeEncoding{"StampAtTheEndSignedNanoseconds", "t", Type::kInt32,
                     [](double, double t) { return 1e9 * (t - 0.0999); }, -0.0999, 1e-7},
        TimeEncoding{"StampAtTheEndAbsolute", "time_stamp", Type::kFloat64,
                     [](double stamp, double t) { return stamp + t - 0.0999; }, -0.0999, 1e-6},
        TimeEncoding{"StampInTheMiddle", "time", Type::kFloat32,
                     [](double, double t) { return t - 0.05; }, -0.05, 1e-7},
        TimeEncoding{"AnotherClock", "timestamp", Type::kFloat64,
                     [](double, double t) { return 4711.0 + t; }, 0.0, 1e-6}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Prefilter, SaysSoWhenTimesComeFromAnotherClock) {
  RawCloudBuilder builder = plainSweep();
  builder.field("timestamp", Type::kFloat64, [](std::size_t i) { return 4711.0 + firedAt(i); });
  const PrefilterResult result = filtered(builder.build());
  EXPECT_NE(result.remark.find("'timestamp'"), std::string::npos) << result.remark;
  EXPECT_NE(result.remark.find("another clock"), std::string::npos) << result.remark;
}

TEST(Prefilter, DoesWithoutTimesThatAreNone) {
  RawCloudBuilder builder = plainSweep();
  builder.field("time", Type::kFloat32, [](std::size_t) { return 0.0; });
  const PrefilterResult equal = filtered(builder.build());
  EXPECT_EQ(equal.problem, "");
  EXPECT_EQ(equal.remark, "");
  EXPECT_FALSE(equal.has_time);

  builder.field("time", Type::kFloat32, [](std::size_t i) { return i == 7 ? kNaN : firedAt(i); });
  const PrefilterResult not_a_number = filtered(builder.build());
  EXPECT_EQ(not_a_number.problem, "");
  EXPECT_NE(not_a_number.remark.find("'time'"), std::string::npos);
  EXPECT_FALSE(not_a_number.has_time);
  for (const Point& point : *not_a_number.cloud) ASSERT_EQ(point.time, 0.0F);
}

TEST(Prefilter, TimesAreThoseOfThePointsThatAreLeft) {
  RawCloudBuilder builder = plainSweep();
  builder.field("x", Type::kFloat32,
                [](std::size_t i) { return i % 3 == 0 ? kNaN : sweptPoint(i).x(); });
  builder.field("t", Type::kUint32, [](std::size_t i) { return 1e9 * firedAt(i); });
  const PrefilterResult result = filtered(builder.build());
  ASSERT_TRUE(result.has_time);
  ASSERT_EQ(result.invalid, 334U);
  std::size_t i = 0;
  for (const Point& point : *result.cloud) {
    i += i % 3 == 0 ? 1 : 0;
    ASSERT_NEAR(point.time, firedAt(i++), 1e-7);
  }
}

class PrefilterNumbers : public ::testing::TestWithParam<Type> {};

TEST_P(PrefilterNumbers, RingAndIntensityOfEveryType) {
  RawCloudBuilder builder = plainSweep();
  builder.field("intensity", GetParam(), [](std::size_t i) { return double(i % 100); }, 4);
  builder.field("ring", GetParam(), [](std::size_t i) { return double(i % 16); }, 1);
  const PrefilterResult result = filtered(builder.build());
  ASSERT_EQ(result.problem, "");
  EXPECT_TRUE(result.has_ring);
  for (std::size_t i = 0; i < result.cloud->size(); ++i) {
    ASSERT_EQ((*result.cloud)[i].ring, i % 16);
    ASSERT_EQ((*result.cloud)[i].intensity, static_cast<float>(i % 100));
  }
}

INSTANTIATE_TEST_SUITE_P(Types, PrefilterNumbers,
                         ::testing::Values(Type::kInt8, Type::kUint8, Type::kInt16, Type::kUint16,
                                           Type::kInt32, Type::kUint32, Type::kFloat32,
                                           Type::kFloat64));

TEST(Prefilter, TakesCoordinatesOfEitherPrecision) {
  for (const Type type : {Type::kFloat32, Type::kFloat64}) {
    const PrefilterResult result = filtered(plainSweep(type).build());
    ASSERT_EQ(result.cloud->size(), 1000U);
    EXPECT_EQ(result.received, 1000U);
    EXPECT_FALSE(result.has_ring);
    for (std::size_t i = 0; i < 1000; ++i) {
      ASSERT_EQ((*result.cloud)[i].getVector3fMap(), sweptPoint(i).cast<float>());
    }
  }
}

TEST(Prefilter, ReadsRowsThatArePaddedAndLeavesOutWhatIsNoEcho) {
  RawCloudBuilder builder;
  builder.width = 50;
  builder.height = 20;
  builder.row_padding = 13;
  const auto coordinate = [](int axis) {
    return [axis](std::size_t i) {
      if (i % 5 == 1) return kNaN;
      if (i % 5 == 2) return 0.0;
      if (i % 5 == 3) return axis == 2 ? std::numeric_limits<double>::infinity() : 1.0;
      return sweptPoint(i)[axis];
    };
  };
  builder.field("z", Type::kFloat32, coordinate(2), 3);  // in no order and not aligned
  builder.field("y", Type::kFloat32, coordinate(1));
  builder.field("x", Type::kFloat32, coordinate(0), 8);
  const PrefilterResult result = filtered(builder.build());
  ASSERT_EQ(result.problem, "");
  EXPECT_EQ(result.received, 1000U);
  EXPECT_EQ(result.invalid, 600U);
  EXPECT_EQ(result.outside, 0U);
  ASSERT_EQ(result.cloud->size(), 400U);
  EXPECT_EQ(result.cloud->width, 400U);
  EXPECT_EQ(result.cloud->height, 1U);
  std::size_t i = 0;
  for (const Point& point : *result.cloud) {
    while (i % 5 >= 1 && i % 5 <= 3) ++i;
    ASSERT_EQ(point.getVector3fMap(), sweptPoint(i++).cast<float>());
  }
}

TEST(Prefilter, PlacesPointsOnTheRobot) {
  test::RandomGeometry random(3, 2.0);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose T_base_lidar = random.pose();
    const RawCloudBuilder builder = plainSweep();
    const PrefilterResult result = filtered(builder.build(), {}, T_base_lidar);
    ASSERT_EQ(result.cloud->size(), 1000U);
    EXPECT_EQ(result.cloud->header.frame_id, "base_link");
    EXPECT_NEAR(stampOf(*result.cloud), builder.stamp_s, 1e-6);
    EXPECT_TRUE(result.cloud->sensor_origin_.head<3>().isApprox(
        T_base_lidar.translation().cast<float>(), 1e-6F));
    for (std::size_t i = 0; i < 1000; ++i) {
      const Eigen::Vector3d expected = T_base_lidar * sweptPoint(i);
      ASSERT_LT(((*result.cloud)[i].getVector3fMap().cast<double>() - expected).norm(), 1e-5);
    }
  }
}

/// Points along the sensor's x axis, 1 cm apart.
RawCloudBuilder ray() {
  RawCloudBuilder builder;
  builder.field("x", Type::kFloat32, [](std::size_t i) { return 0.01 * double(i + 1); });
  builder.field("y", Type::kFloat32, [](std::size_t) { return 0.0; });
  builder.field("z", Type::kFloat32, [](std::size_t) { return 0.0; });
  return builder;
}

TEST(Prefilter, MeasuresRangeFromTheSensor) {
  PrefilterConfig config;
  config.min_range_m = 2.005;
  config.max_range_m = 6.005;
  Pose T_base_lidar = Pose::Identity();
  T_base_lidar.translation().x() = -4.0;  // the base is among the points that stay
  const PrefilterResult result = filtered(ray().build(), config, T_base_lidar);
  ASSERT_EQ(result.cloud->size(), 400U);
  EXPECT_EQ(result.outside, 600U);
  EXPECT_NEAR(result.cloud->front().x, 2.01 - 4.0, 1e-5);
  EXPECT_NEAR(result.cloud->back().x, 6.0 - 4.0, 1e-5);
}

TEST(Prefilter, CutsOutTheRobotInItsOwnFrame) {
  PrefilterConfig config;
  config.min_range_m = 0.0;
  config.self_box_min_x_m = -0.505;
  config.self_box_max_x_m = 0.505;
  config.self_box_min_y_m = 0.9;
  config.self_box_max_y_m = 1.1;
  config.self_box_min_z_m = -0.1;
  config.self_box_max_z_m = 0.1;
  Pose T_base_lidar = Pose::Identity();
  T_base_lidar.translation() << -3.0, 1.0, 0.0;
  const PrefilterResult result = filtered(ray().build(), config, T_base_lidar);
  EXPECT_EQ(result.outside, 101U);
  for (const Point& point : *result.cloud) ASSERT_GT(std::abs(point.x), 0.505F);

  config.self_box_max_z_m = config.self_box_min_z_m;  // min >= max: off
  EXPECT_EQ(filtered(ray().build(), config, T_base_lidar).outside, 0U);
}

TEST(Prefilter, RefusesRangesThatLeaveNothing) {
  PrefilterConfig config;
  config.min_range_m = config.max_range_m = 3.0;
  EXPECT_THROW(Prefilter{config}, std::invalid_argument);
}

/// A simulated scan of which the field `time` has been taken away.
class PrefilterFiringOrder : public ::testing::Test {
 protected:
  PrefilterFiringOrder() : run_(test::simulatedRun(sim::test::shipped("small"), "vlp16_sparse", 0.2)) {
    raw_ = run_.rawCloud(0);
    raw_.header.fields.pop_back();
  }

  test::SimulatedRun run_;
  OwnedRawCloud raw_;
};

TEST_F(PrefilterFiringOrder, GivesTimesToACloudThatHasNone) {
  const PrefilterResult result = filtered(raw_, {}, run_.T_base_lidar);
  ASSERT_TRUE(result.has_time);
  ASSERT_EQ(result.cloud->size(), run_.scans[0].returns.size());
  for (std::size_t i = 0; i < result.cloud->size(); ++i) {
    ASSERT_NEAR((*result.cloud)[i].time, 1e-9 * run_.scans[0].returns[i].offset_ns, 1e-3);
  }
}

TEST_F(PrefilterFiringOrder, DoesNotWhereItIsNotWantedOrTheCloudIsOrganized) {
  PrefilterConfig config;
  config.sweep_period_s = 0.0;
  EXPECT_FALSE(filtered(raw_, config, run_.T_base_lidar).has_time);

  raw_.header.height = 2;
  raw_.header.width /= 2;
  raw_.header.row_step = raw_.header.width * raw_.header.point_step;
  EXPECT_FALSE(filtered(raw_, {}, run_.T_base_lidar).has_time);
}

}  // namespace
}  // namespace mrpt_sgraphs
