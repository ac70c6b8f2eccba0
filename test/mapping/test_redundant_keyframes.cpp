// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/redundant_keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

constexpr double kSpacing_m = 1.0;

/// Keyframes with clouds in room 0 on floor 0, all dropped unless a test says otherwise.
class RedundantKeyframes : public ::testing::Test {
 protected:
  KeyframeNode& add(const Eigen::Vector3d& place_map) {
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{graph_.keyframes.size()};
    keyframe.T_map_base.translation() = place_map;
    keyframe.cloud = Cloud::ConstPtr(new Cloud);
    keyframe.floor = FloorId{0};
    keyframe.room = RoomId{0};
    keyframe.marginalized = true;
    graph_.keyframes.push_back(keyframe);
    return graph_.keyframes.edit(graph_.keyframes.size() - 1);
  }

  std::vector<uint64_t> redundant() const {
    std::vector<uint64_t> ids;
    for (const KeyframeId id : redundantKeyframes(graph_, kSpacing_m)) ids.push_back(id.value);
    return ids;
  }

  GraphSnapshot graph_;
};

using Ids = std::vector<uint64_t>;

TEST_F(RedundantKeyframes, OfTwoAtOnePlaceTheOlderStays) {
  add({0.0, 0.0, 0.0});
  add({0.6, 0.6, 0.4});
  EXPECT_EQ(redundant(), Ids{1});
}

TEST_F(RedundantKeyframes, ThoseFartherApartThanTheSpacingStay) {
  add({0.0, 0.0, 0.0});
  add({0.6, 0.6, 0.6});
  EXPECT_EQ(redundant(), Ids{}) << "1.04 m";
}

TEST_F(RedundantKeyframes, OneThatGoesMakesNoOtherGo) {
  add({0.0, 0.0, 0.0});
  add({0.7, 0.0, 0.0});
  add({1.4, 0.0, 0.0});
  EXPECT_EQ(redundant(), Ids{1}) << "the third is near to the second alone";
}

TEST_F(RedundantKeyframes, WhatTheOptimizationKnowsStays) {
  add({0.0, 0.0, 0.0});
  add({0.1, 0.0, 0.0}).marginalized = false;
  EXPECT_EQ(redundant(), Ids{});
}

TEST_F(RedundantKeyframes, AKeptOneStandsForThoseThatComeLater) {
  add({0.0, 0.0, 0.0}).marginalized = false;
  add({0.1, 0.0, 0.0});
  EXPECT_EQ(redundant(), Ids{1});
}

TEST_F(RedundantKeyframes, TheOtherSideOfAWallOrCeilingIsAnotherPlace) {
  add({0.0, 0.0, 0.0});
  add({0.1, 0.0, 0.0}).room = RoomId{1};
  add({0.2, 0.0, 0.0}).floor = FloorId{1};
  add({0.3, 0.0, 0.0}).room.reset();
  EXPECT_EQ(redundant(), Ids{});
}

TEST_F(RedundantKeyframes, ThoseInNoRoomAreRedundantAmongThemselves) {
  add({0.0, 0.0, 0.0}).room.reset();
  add({0.5, 0.0, 0.0}).room.reset();
  EXPECT_EQ(redundant(), Ids{1});
}

TEST_F(RedundantKeyframes, OneWithoutACloudStandsForNoOther) {
  add({0.0, 0.0, 0.0}).cloud.reset();
  add({0.1, 0.0, 0.0});
  EXPECT_EQ(redundant(), Ids{});
}

TEST_F(RedundantKeyframes, NeitherTheMapsOriginNorItsAxesMatter) {
  for (int k = 0; k < 200; ++k) {
    add({3.0 * std::cos(0.9 * k), 2.0 * std::sin(1.7 * k), 0.1 * std::sin(2.3 * k)});
  }
  const Ids before = redundant();
  EXPECT_GT(before.size(), 100U);
  Pose T_other_map = Pose::Identity();
  T_other_map.linear() = expSO3({0.3, -0.2, 1.1});
  T_other_map.translation() << -812.3, 77.7, 4.4;
  for (std::size_t k = 0; k < graph_.keyframes.size(); ++k) {
    KeyframeNode& keyframe = graph_.keyframes.edit(k);
    keyframe.T_map_base = T_other_map * keyframe.T_map_base;
  }
  EXPECT_EQ(redundant(), before);
}

TEST_F(RedundantKeyframes, AfterManyToursThereAreAsManyCloudsAsPlaces) {
  constexpr int kPlaces = 20;
  for (int tour = 0; tour < 10; ++tour) {
    for (int k = 0; k < kPlaces; ++k) add({1.5 * k, 0.3 * std::sin(tour), 0.0});
  }
  EXPECT_EQ(redundant().size(), 9U * kPlaces);
}

TEST_F(RedundantKeyframes, ASpacingThatIsNoneIsRefused) {
  EXPECT_THROW(redundantKeyframes(graph_, 0.0), std::invalid_argument);
  EXPECT_THROW(redundantKeyframes(graph_, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace mrpt_sgraphs
