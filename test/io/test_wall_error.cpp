// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mrpt_sgraphs/io/wall_error.h"
#include "random_walk.h"

namespace mrpt_sgraphs {
namespace {

using Ids = std::vector<uint64_t>;

constexpr double kHeight_m = 2.8;

/// An upright rectangle in the plane y = `y`, from x = `begin` to x = `end`.
Outline3 uprightAt(double y, double begin, double end, double top = kHeight_m) {
  return {{begin, y, 0.0}, {end, y, 0.0}, {end, y, top}, {begin, y, top}};
}

/// Faces of one building. All look to +y, where not said otherwise.
///
///     0, 1   two offices along a facade: x 0..4 and 4.2..8, y = 0
///     2      the other side of the same wall: x 0..8, y = -0.2, looks to -y
///     3      far along in the same plane: x 12..24, y = 0, with a gate of 3 m from x = 16 on
std::vector<TrueWall> building() {
  const auto face = [](uint64_t id, double y, double side, double begin, double end) {
    TrueWall wall;
    wall.id = id;
    wall.plane = Plane{{0.0, side, 0.0}, side * y};
    wall.extent.outline = uprightAt(y, begin, end);
    wall.seen_m2 = 5.0;
    return wall;
  };
  std::vector<TrueWall> walls{face(0, 0.0, 1.0, 0.0, 4.0), face(1, 0.0, 1.0, 4.2, 8.0),
                              face(2, -0.2, -1.0, 0.0, 8.0), face(3, 0.0, 1.0, 12.0, 24.0)};
  walls[3].extent.holes = {uprightAt(0.0, 16.0, 19.0, 2.5)};
  return walls;
}

/// A wall of a run: looks to +y, lies in the plane y = `y`.
WallNode seen(double begin, double end, double y = 0.0) {
  WallNode wall;
  wall.plane_map = {Eigen::Vector3d::UnitY(), y};
  wall.extent_map.outline = uprightAt(y, begin, end);
  return wall;
}

WallNode otherSide() {
  WallNode wall = seen(0.0, 8.0, -0.2);
  wall.plane_map = {-Eigen::Vector3d::UnitY(), 0.2};
  return wall;
}

WallNode moved(const Pose& T, WallNode wall) {
  wall.plane_map = T * wall.plane_map;
  for (Eigen::Vector3d& corner : wall.extent_map.outline) corner = T * corner;
  return wall;
}

/// The walls get the ids 10, 11, ...
WallErrors evaluate(std::vector<WallNode> found, const Pose& T_truth_map = Pose::Identity()) {
  for (std::size_t k = 0; k < found.size(); ++k) found[k].id = WallId{10 + k};
  return evaluateWalls(building(), found, T_truth_map);
}

TEST(WallErrors, OfThatWhichIsThereAreNone) {
  const WallErrors errors =
      evaluate({seen(0.0, 4.0), seen(4.2, 8.0), otherSide(), seen(12.0, 24.0)});
  EXPECT_EQ(errors.found, 4u);
  EXPECT_EQ(errors.true_walls, 4u);
  EXPECT_EQ(errors.precision(), 1.0);
  EXPECT_EQ(errors.recall(), 1.0);
  EXPECT_EQ(errors.duplicates, 0u);
  EXPECT_NEAR(errors.normal_deg.p90, 0.0, 1e-9);
  EXPECT_NEAR(errors.offset_m.p90, 0.0, 1e-9);
}

TEST(WallErrors, AreThoseInTheTruthsFrame) {
  const Pose T_truth_map = test::someMotion();
  const auto inMap = [&](const WallNode& wall) { return moved(T_truth_map.inverse(), wall); };
  const WallErrors errors =
      evaluate({inMap(seen(0.0, 4.0, 0.03)), inMap(otherSide())}, T_truth_map);
  EXPECT_EQ(errors.right, 2u);
  EXPECT_EQ(errors.missed, (Ids{1, 3}));
  EXPECT_NEAR(errors.normal_deg.p90, 0.0, 1e-6);
  EXPECT_NEAR(errors.offset_m.median, 0.015, 1e-9);
}

TEST(WallErrors, OneWallAlongTwoOfficesFindsBoth) {
  const WallErrors errors = evaluate({seen(0.0, 8.0)});
  EXPECT_EQ(errors.precision(), 1.0);
  EXPECT_EQ(errors.missed, (Ids{2, 3}));
  EXPECT_EQ(errors.found_true, 2u);
  EXPECT_EQ(errors.duplicates, 0u);
}

TEST(WallErrors, AWallThatReachesALittleIntoTheNextOfficeDoesNotFindItsFace) {
  EXPECT_EQ(evaluate({seen(0.0, 4.5)}).missed, (Ids{1, 2, 3}));
}

TEST(WallErrors, TheOtherSideIsAnotherWall) {
  WallNode wall = seen(0.0, 4.0);
  wall.plane_map = {-Eigen::Vector3d::UnitY(), 0.0};  // and 0.2 m behind face 2
  const WallErrors errors = evaluate({wall});
  EXPECT_EQ(errors.right, 0u);
  EXPECT_EQ(errors.wrong, (Ids{10}));
  EXPECT_TRUE(std::isnan(errors.offset_m.median));
}

TEST(WallErrors, WhatIsTooFarOffOrTooMuchTurnedIsWrong) {
  const auto turned = [](double angle_deg) {
    const Eigen::Vector3d middle(2.0, 0.0, 0.5 * kHeight_m);
    Pose T = Pose::Identity();
    T.linear() =
        Eigen::AngleAxisd(angle_deg * M_PI / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T.translation() = middle - T.linear() * middle;
    return moved(T, seen(0.0, 4.0));
  };
  EXPECT_EQ(evaluate({seen(0.0, 4.0, 0.14), turned(4.9)}).right, 2u);
  EXPECT_EQ(evaluate({seen(0.0, 4.0, 0.16), turned(5.1)}).wrong, (Ids{10, 11}));

  const WallErrors errors = evaluate({turned(2.0)});
  EXPECT_NEAR(errors.normal_deg.median, 2.0, 1e-9);
  EXPECT_NEAR(errors.offset_m.median, 0.0, 1e-6);  // at the middle, not 4 m off at the origin
}

TEST(WallErrors, HalfOfAWallHasToLieOnTheTrueOne) {
  EXPECT_EQ(evaluate({seen(22.0, 26.0)}).right, 1u);  // 2.2 of 4 m
  EXPECT_EQ(evaluate({seen(22.5, 27.0)}).right, 0u);  // 1.7 of 4.5 m
  EXPECT_EQ(evaluate({seen(16.0, 19.0)}).right, 0u);  // in the gate
  EXPECT_EQ(evaluate({seen(12.0, 24.0)}).right, 1u);  // across it
}

TEST(WallErrors, AWallWithoutAnAreaIsWrong) {
  WallNode none = seen(0.0, 4.0);
  none.extent_map.outline.clear();
  WallNode line = seen(0.0, 4.0);
  line.extent_map.outline.resize(2);
  EXPECT_EQ(evaluate({none, line}).wrong, (Ids{10, 11}));
}

TEST(WallErrors, AFaceFoundTwiceIsTold) {
  const WallErrors twice = evaluate({seen(0.0, 2.0), seen(3.0, 4.0, 0.05)});
  EXPECT_EQ(twice.twice, (Ids{0}));
  EXPECT_EQ(twice.precision(), 1.0);
  EXPECT_EQ(twice.found_true, 1u);
  EXPECT_EQ(evaluate({seen(0.0, 4.0), seen(4.2, 8.0)}).duplicates, 0u);      // two faces
  EXPECT_EQ(evaluate({seen(12.0, 15.0), seen(20.0, 24.0)}).duplicates, 0u);  // far apart
}

TEST(WallErrors, WhatWasHardlySeenNeedNotBeFound) {
  std::vector<TrueWall> truth = building();
  truth[2].seen_m2 = 1.99;
  truth[3].seen_m2 = 0.0;
  WallErrors errors = evaluateWalls(truth, {seen(0.0, 4.0)}, Pose::Identity());
  EXPECT_EQ(errors.true_walls, 2u);
  EXPECT_EQ(errors.recall(), 0.5);
  EXPECT_EQ(errors.missed, (Ids{1}));

  truth[0].seen_m2.reset();
  errors = evaluateWalls(truth, {seen(0.0, 4.0), seen(30.0, 34.0)}, Pose::Identity());
  EXPECT_FALSE(errors.seen_is_known);
  EXPECT_TRUE(std::isnan(errors.recall()));
  EXPECT_EQ(errors.precision(), 0.5);
}

TEST(WallErrors, NothingFoundHasNoPrecision) {
  const WallErrors errors = evaluate({});
  EXPECT_TRUE(std::isnan(errors.precision()));
  EXPECT_EQ(errors.recall(), 0.0);
}

}  // namespace
}  // namespace mrpt_sgraphs
