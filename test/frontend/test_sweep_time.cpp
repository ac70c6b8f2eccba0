// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/sweep_time.h"

#include <gtest/gtest.h>

#include <limits>

namespace mrpt_sgraphs {
namespace {

constexpr double kStamp_s = 1.7e9;

/// A sweep's times from `first` on, equally far apart.
std::vector<double> sweep(double first, double length) {
  std::vector<double> values;
  for (int k = 0; k <= 1000; ++k) values.push_back(first + 1e-3 * k * length);
  return values;
}

double read(const SweepTimes& times, double value) {
  return (value - times.origin) * times.unit_s;
}

TEST(SweepTime, DoesNotDependOnUnitAndEpoch) {
  // two milliseconds or less could be seconds of a finer unit; no sensor is so fast
  for (const double length_s : {0.0025, 0.0125, 0.1, 1.0, 1.9}) {
    for (const double first_s : {-length_s, -0.5 * length_s, 0.0, 0.01 * length_s}) {
      for (const double epoch_s : {0.0, kStamp_s}) {
        for (const double per_s : {1.0, 1e3, 1e6, 1e9}) {
          SCOPED_TRACE(testing::Message() << length_s << " s from " << first_s << " s, epoch "
                                          << epoch_s << " s, " << per_s << " per second");
          const std::vector<double> values =
              sweep((epoch_s + first_s) * per_s, length_s * per_s);
          const SweepTimes times = sweepTimes(values, kStamp_s, false);
          ASSERT_TRUE(times.usable);
          EXPECT_EQ(times.remark, "");
          EXPECT_NEAR(read(times, values.front()), first_s, 1e-6);
          EXPECT_NEAR(read(times, values.back()), first_s + length_s, 1e-6);
        }
      }
    }
  }
}

TEST(SweepTime, IntegersAreNeverSeconds) {
  // two microseconds apart: as floats these could be seconds
  const SweepTimes times = sweepTimes({0.0, 1.0, 2.0}, kStamp_s, true);
  EXPECT_TRUE(times.usable);
  EXPECT_EQ(times.unit_s, 1e-3);
  EXPECT_EQ(sweepTimes({0.0, 1.0, 2.0}, kStamp_s, false).unit_s, 1.0);
}

TEST(SweepTime, AnotherClockStartsAtTheStamp) {
  const SweepTimes times = sweepTimes(sweep(86400.25, 0.1), kStamp_s, false);
  ASSERT_TRUE(times.usable);
  EXPECT_EQ(read(times, 86400.25), 0.0);
  EXPECT_NEAR(read(times, 86400.35), 0.1, 1e-9);
  EXPECT_NE(times.remark.find("another clock"), std::string::npos);
}

TEST(SweepTime, TheEarliestPointOfAnotherClockNeedNotComeFirst) {
  std::vector<double> values = sweep(500.0, 0.1);
  std::swap(values.front(), values.back());
  const SweepTimes times = sweepTimes(values, kStamp_s, false);
  EXPECT_NEAR(read(times, values.front()), 0.1, 1e-9);
  EXPECT_EQ(read(times, values.back()), 0.0);
}

TEST(SweepTime, HasNoneWhereAllAreEqual) {
  for (const double value : {0.0, kStamp_s, std::numeric_limits<double>::infinity()}) {
    const SweepTimes times = sweepTimes(std::vector<double>(100, value), kStamp_s, false);
    EXPECT_FALSE(times.usable);
    EXPECT_EQ(times.remark, "");
  }
  EXPECT_FALSE(sweepTimes({}, kStamp_s, false).usable);
  EXPECT_FALSE(sweepTimes({0.05}, kStamp_s, false).usable);
}

TEST(SweepTime, SaysWhyTimesAreOfNoUse) {
  for (const double odd : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (const std::size_t at : {0U, 500U, 1000U}) {
      std::vector<double> values = sweep(0.0, 0.1);
      values[at] = odd;
      const SweepTimes times = sweepTimes(values, kStamp_s, false);
      EXPECT_FALSE(times.usable);
      EXPECT_NE(times.remark.find("not finite"), std::string::npos) << times.remark;
    }
  }
  const SweepTimes short_sweep = sweepTimes({0.0, 2e-4, 5e-4}, kStamp_s, false);
  EXPECT_FALSE(short_sweep.usable);
  EXPECT_NE(short_sweep.remark.find("no sweep in any unit"), std::string::npos);
  const SweepTimes long_sweep = sweepTimes({0.0, 1e10, 3e10}, kStamp_s, false);
  EXPECT_FALSE(long_sweep.usable);
  EXPECT_NE(long_sweep.remark.find("30000000000"), std::string::npos) << long_sweep.remark;
}

}  // namespace
}  // namespace mrpt_sgraphs
