// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "far_thinning.h"

namespace mrpt_sgraphs {
namespace {

/// Every 10 cm along x.
std::vector<Eigen::Vector3d> row(int count) {
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < count; ++k) places.emplace_back(0.1 * k, 0.0, 0.0);
  return places;
}

std::size_t countOf(const std::vector<std::size_t>& shown) {
  return std::set<std::size_t>(shown.begin(), shown.end()).size();
}

TEST(FarThinning, ShowsAllThatIsNear) {
  const auto places = row(100);
  const auto shown = thinnedFarAway(places, {{5.0, 0.0, 9.0}, 0.0}, 20.0);
  EXPECT_EQ(countOf(shown), places.size());
}

TEST(FarThinning, ShowsAllWithoutALimit) {
  const auto places = row(100);
  EXPECT_EQ(countOf(thinnedFarAway(places, {{0.0, 0.0, 1e6}, 0.0}, 0.0)), places.size());
}

TEST(FarThinning, ShowsOneForAllThatAreCloseTogetherFarAway) {
  const auto places = row(1000);
  const Eye eye{{50.0, 0.0, 300.0}, 0.0};
  const auto shown = thinnedFarAway(places, eye, 30.0);
  EXPECT_LT(countOf(shown), places.size() / 10);
  EXPECT_GT(countOf(shown), 5U);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(shown[shown[k]], shown[k]) << "what stands for others is shown itself";
    EXPECT_LE(shown[k], k) << "the first of them stands for all";
    const double apart_m = (places[k] - places[shown[k]]).norm();
    EXPECT_LE(apart_m, std::sqrt(3.0) * kCellOverDistance * eye.distanceTo(places[k]));
  }
}

TEST(FarThinning, ThinsMoreTheFartherItIs) {
  const auto places = row(1000);
  std::size_t before = places.size() + 1;
  for (const double height_m : {20.0, 80.0, 320.0, 1280.0}) {
    const std::size_t count = countOf(thinnedFarAway(places, {{50.0, 0.0, height_m}, 0.0}, 30.0));
    EXPECT_LT(count, before);
    before = count;
  }
}

TEST(FarThinning, KeepsTheNearEndOfALongRow) {
  const auto places = row(3000);  // 300 m
  const auto shown = thinnedFarAway(places, {{0.0, 0.0, 1.0}, 0.0}, 30.0);
  for (std::size_t k = 0; k < 290; ++k) EXPECT_EQ(shown[k], k);
  EXPECT_LT(countOf(shown), 1000U);
}

TEST(FarThinning, GoesByTheSizeOfAViewWithoutPerspective) {
  const auto places = row(1000);
  EXPECT_EQ(countOf(thinnedFarAway(places, {{0.0, 0.0, 500.0}, 10.0}, 30.0)), places.size());
  EXPECT_LT(countOf(thinnedFarAway(places, {{50.0, 0.0, 1.0}, 400.0}, 30.0)), places.size() / 10);
}

}  // namespace
}  // namespace mrpt_sgraphs
