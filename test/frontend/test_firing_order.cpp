// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/firing_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrpt_sgraphs {
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;

/// A spinning sensor in a room, whose cloud comes column by column.
struct Spin {
  double start_rad = 0.0;
  double sweep_rad = kTurn_rad;  ///< Negative: clockwise.
  int columns = 900;
  int rings = 16;
  std::vector<std::pair<double, double>> openings;  ///< Fractions of the sweep without returns.
};

/// The cloud; each point's time is the fraction of a turn at which it was fired.
Cloud spun(const Spin& spin) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> range(1.5F, 12.0F);
  Cloud cloud;
  for (int column = 0; column < spin.columns; ++column) {
    const double swept = double(column) / spin.columns;
    const bool open = std::any_of(
        spin.openings.begin(), spin.openings.end(),
        [&](const auto& opening) { return swept >= opening.first && swept < opening.second; });
    if (open) continue;
    const double azimuth = spin.start_rad + swept * spin.sweep_rad;
    for (int ring = 0; ring < spin.rings; ++ring) {
      Point point;
      const float r = range(generator);
      point.x = r * static_cast<float>(std::cos(azimuth));
      point.y = r * static_cast<float>(std::sin(azimuth));
      point.z = 0.1F * r * static_cast<float>(ring - 8);
      point.time = static_cast<float>(swept * std::abs(spin.sweep_rad) / kTurn_rad);
      point.ring = static_cast<std::uint16_t>(ring);
      cloud.push_back(point);
    }
  }
  return cloud;
}

void expectFractionsOfTheSweep(const Cloud& cloud) {
  const std::vector<float> fractions = sweepFractions(cloud);
  ASSERT_EQ(fractions.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_NEAR(fractions[i], cloud[i].time - cloud[0].time, 1e-4) << "point " << i;
  }
}

TEST(FiringOrder, IsFoundInEitherDirectionFromAnyStart) {
  for (const double direction : {1.0, -1.0}) {
    for (int k = 0; k < 16; ++k) {
      Spin spin;
      spin.start_rad = -M_PI + kTurn_rad * k / 16.0;
      spin.sweep_rad = direction * kTurn_rad;
      SCOPED_TRACE(testing::Message() << spin.start_rad << " " << spin.sweep_rad);
      expectFractionsOfTheSweep(spun(spin));
    }
  }
}

TEST(FiringOrder, TakesSweepsOfALittleMoreOrLessThanATurn) {
  for (const double part : {0.8, 0.95, 1.05}) {
    Spin spin;
    spin.start_rad = 2.0;
    spin.sweep_rad = -part * kTurn_rad;
    expectFractionsOfTheSweep(spun(spin));
  }
}

TEST(FiringOrder, JumpsOverOpeningsWithoutReturns) {
  Spin spin;
  spin.sweep_rad = -kTurn_rad;
  spin.openings = {{0.05, 0.15}, {0.3, 0.42}, {0.6, 0.65}, {0.8, 0.95}};
  expectFractionsOfTheSweep(spun(spin));
  spin.openings = {{0.0, 0.1}};  // at its start
  expectFractionsOfTheSweep(spun(spin));
}

TEST(FiringOrder, IsNotThereInOtherOrders) {
  const Cloud cloud = spun({});
  Cloud sorted = cloud;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Point& a, const Point& b) { return a.ring < b.ring; });
  EXPECT_TRUE(sweepFractions(sorted).empty()) << "by ring";

  Cloud by_voxel = cloud;
  std::stable_sort(by_voxel.begin(), by_voxel.end(), [](const Point& a, const Point& b) {
    return std::make_pair(std::floor(a.x), std::floor(a.y)) <
           std::make_pair(std::floor(b.x), std::floor(b.y));
  });
  EXPECT_TRUE(sweepFractions(by_voxel).empty()) << "by voxel";

  for (unsigned seed = 0; seed < 20; ++seed) {
    Cloud shuffled = cloud;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(seed));
    EXPECT_TRUE(sweepFractions(shuffled).empty()) << "shuffled " << seed;
  }
}

TEST(FiringOrder, IsNotThereWithoutAWholeTurn) {
  Spin half;
  half.sweep_rad = M_PI;
  EXPECT_TRUE(sweepFractions(spun(half)).empty());
  Spin twice;
  twice.sweep_rad = 2.0 * kTurn_rad;
  EXPECT_TRUE(sweepFractions(spun(twice)).empty());
}

TEST(FiringOrder, NeedsPointsEnough) {
  EXPECT_TRUE(sweepFractions({}).empty());
  Cloud few = spun({});
  few.points.resize(100);
  EXPECT_TRUE(sweepFractions(few).empty());
}

}  // namespace
}  // namespace mrpt_sgraphs
