// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/wall_layer.h"
#include "wall_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::Face;
using test::kPairsOfSixRooms;
using test::kWallsOfSixRooms;
using test::PlaneWorld;
using test::WallLab;

constexpr double kRadPerDeg = M_PI / 180.0;

Pose poseAt(double x, double y, double yaw_rad = 0.0) {
  Pose T = Pose::Identity();
  T.translation() << x, y, 0.8;
  T.linear() = expSO3({0.0, 0.0, yaw_rad});
  return T;
}

void walkAll(WallLab* lab) {
  for (const Pose& T_world_base : test::walkThroughSixRooms()) lab->step(T_world_base);
}

void expectEveryWallOnce(const WallLab& lab, double tolerance_m = 0.05) {
  EXPECT_EQ(lab.walls(), static_cast<std::size_t>(kWallsOfSixRooms));
  const auto on_faces = lab.wallsOnFaces(tolerance_m);
  EXPECT_EQ(on_faces.count(-1), 0U);
  for (const auto& [face, walls] : on_faces) EXPECT_EQ(walls, 1) << "face " << face;
}

TEST(WallLayer, FindsEveryWallOfABuildingOnceAndItsPairs) {
  WallLab lab(test::sixRooms());
  walkAll(&lab);
  expectEveryWallOnce(lab);
  EXPECT_EQ(lab.pairs(), static_cast<std::size_t>(kPairsOfSixRooms));
  for (std::size_t k = 0; k < lab.truth.size(); ++k) {
    const Pose T_error = lab.truth[k].inverse() * lab.graph.pose(KeyframeId{k});
    EXPECT_LT(T_error.translation().head<2>().norm(), 0.05) << k;
  }
}

TEST(WallLayer, ResidualsAreAsTheirCovariancesSay) {
  WallLab lab(test::sixRooms());
  walkAll(&lab);
  // three for each sighting, less the degrees of freedom that the walls and keyframes took
  const double sightings = static_cast<double>(lab.observations());
  const double walls = static_cast<double>(lab.walls());
  EXPECT_GT(lab.meanChi2(), 3.0 - (3.0 * walls + 3.0 * lab.truth.size()) / sightings - 0.2);
  EXPECT_LT(lab.meanChi2(), 3.2);
}

/// The same walls wherever the map's origin is and wherever its x points.
class WallLayerInMaps : public ::testing::TestWithParam<std::pair<double, double>> {};
INSTANTIATE_TEST_SUITE_P(YawAndDistance, WallLayerInMaps,
                         ::testing::Values(std::pair{45.0, 0.0}, std::pair{17.0, 0.0},
                                           std::pair{0.0, 500.0}, std::pair{130.0, 500.0}));

TEST_P(WallLayerInMaps, DoNotMatter) {
  WallLab plain(test::sixRooms());
  walkAll(&plain);
  WallLab moved(test::sixRooms());
  const Pose T_map_world =
      poseAt(GetParam().second, -GetParam().second, GetParam().first * kRadPerDeg);
  moved.setMap(T_map_world);
  walkAll(&moved);
  expectEveryWallOnce(moved);
  const GraphSnapshotConstPtr a = plain.graph.snapshot();
  const GraphSnapshotConstPtr b = moved.graph.snapshot();
  ASSERT_EQ(a->walls.size(), b->walls.size());
  EXPECT_EQ(a->factors.size(), b->factors.size());
  for (std::size_t k = 0; k < a->walls.size(); ++k) {
    const Plane turned = T_map_world * a->walls[k].plane_map;
    EXPECT_NEAR(turned.normal.dot(b->walls[k].plane_map.normal), 1.0, 1e-6);
    const Eigen::Vector3d corner = T_map_world * a->walls[k].extent_map.outline.front();
    EXPECT_NEAR(b->walls[k].plane_map.normal.dot(corner) - b->walls[k].plane_map.distance, 0.0,
                5e-3);
  }
}

TEST(WallLayer, StandingStillAddsNothing) {
  WallLab lab(test::sixRooms());
  for (int k = 0; k < 6; ++k) lab.step(poseAt(2.0, 2.0));
  const std::size_t walls = lab.walls();
  const std::size_t tracks = lab.layer.tracks().size();
  EXPECT_GE(walls, 4U);
  for (int k = 0; k < 60; ++k) lab.step(poseAt(2.0, 2.0));
  EXPECT_EQ(lab.walls(), walls);
  EXPECT_LE(lab.layer.tracks().size(), tracks);
}

TEST(WallLayer, AWallHasToBeSeenOftenEnough) {
  WallLayerConfig config;
  config.min_sightings = 3;
  WallLab lab(test::sixRooms(), config);
  lab.step(poseAt(2.0, 2.0));
  lab.step(poseAt(2.2, 2.0));
  EXPECT_EQ(lab.walls(), 0U);
  EXPECT_EQ(lab.observations(), 0U);
  lab.step(poseAt(2.4, 2.0));
  EXPECT_GE(lab.walls(), 4U);
  EXPECT_GE(lab.observations(), 12U) << "all that was seen of it so far";
}

TEST(WallLayer, WhatIsNotSeenAgainIsForgotten) {
  WallLayerConfig config;
  config.forget_after_m = 3.0;
  PlaneWorld world;
  world.addWall({0.0, 2.0}, {40.0, 2.0});
  world.range_m = 5.0;
  world.faces.push_back(Face{{1.0, -2.0}, {2.0, -2.0}, {}});  // a board, seen from the left
  WallLab lab(world, config);
  lab.step(poseAt(1.0, 0.0));
  EXPECT_EQ(lab.layer.tracks().size(), 2U);
  lab.world.faces.pop_back();
  for (double x = 2.0; x < 10.0; x += 1.0) lab.step(poseAt(x, 0.0));
  EXPECT_EQ(lab.layer.tracks().size(), 1U);
  EXPECT_EQ(lab.walls(), 1U);
}

/// A shelf 0.4 m in front of a wall, both seen: never one.
TEST(WallLayer, AShelfInFrontOfAWallIsNotTheWall) {
  PlaneWorld world;
  world.faces.push_back(Face{{12.0, 3.0}, {0.0, 3.0}, {}});
  world.faces.push_back(Face{{6.0, 2.6}, {4.0, 2.6}, {}, 0.0, 1.8});
  world.faces.push_back(Face{{0.0, 3.0}, {0.0, -3.0}, {}});
  WallLab lab(world);
  for (double x = 1.0; x < 11.0; x += 0.5) lab.step(poseAt(x, 0.0));
  EXPECT_EQ(lab.walls(), 3U);
  EXPECT_EQ(lab.wallsOnFaces().count(-1), 0U);
}

TEST(WallLayer, ADoorIsOneWallAndAWideOpeningIsTwo) {
  for (const double opening_m : {0.9, 2.5}) {
    SCOPED_TRACE(opening_m);
    PlaneWorld world;
    world.addWall({0.0, 2.0}, {6.0, 2.0});
    world.addWall({6.0 + opening_m, 2.0}, {12.0, 2.0});
    world.addWall({0.0, -2.0}, {0.0, 2.0});
    WallLab lab(world);
    for (double x = 0.8; x < 11.0; x += 0.6) lab.step(poseAt(x, 0.0));
    EXPECT_EQ(lab.walls(), opening_m < 1.5 ? 2U : 3U);
  }
}

TEST(WallLayer, ExtentsAreOutlinesWithDoors) {
  WallLab lab(test::sixRooms());
  walkAll(&lab);
  int doors = 0;
  for (const WallNode& wall : lab.graph.snapshot()->walls) {
    ASSERT_GE(wall.extent_map.outline.size(), 4U);
    Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
    const Outline3& ring = wall.extent_map.outline;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      EXPECT_NEAR(wall.plane_map.normal.dot(ring[k]), wall.plane_map.distance, 1e-9);
      EXPECT_GT(ring[k].z(), -0.15);
      EXPECT_LT(ring[k].z(), 2.85);
      twice_area += (ring[k] - ring[0]).cross(ring[(k + 1) % ring.size()] - ring[0]);
    }
    EXPECT_GT(twice_area.dot(wall.plane_map.normal), 0.0) << "counter-clockwise from the front";
    for (const Outline3& hole : wall.extent_map.holes) {
      double low = 10.0;
      for (const Eigen::Vector3d& corner : hole) low = std::min(low, corner.z());
      if (low < 0.15) ++doors;
    }
  }
  EXPECT_GE(doors, 10) << "three doors in two walls, from both sides";
}

/// Half of the way the odometry slips by 0.5 m across the corridor: walls are there twice until the
/// loop is closed, then once.
TEST(WallLayer, WallsThatALoopBringsTogetherAreMerged) {
  WallLab lab(test::sixRooms());
  const std::vector<Pose> walk = test::walkThroughSixRooms();
  const std::size_t half = walk.size() / 2;
  for (std::size_t k = 0; k < walk.size(); ++k) {
    lab.step(walk[k], k == half ? Pose(Eigen::Translation3d(0.5, 0.5, 0.0)) : Pose::Identity());
  }
  EXPECT_GT(lab.walls(), static_cast<std::size_t>(kWallsOfSixRooms));
  const std::size_t sightings_before = lab.observations();
  std::size_t old = 0;  // the pose that the last one is nearest to
  for (std::size_t k = 0; k < half; ++k) {
    const auto distance = [&](std::size_t i) {
      return (walk[i].translation() - walk.back().translation()).norm();
    };
    if (distance(k) < distance(old)) old = k;
  }
  lab.closeLoop(old);
  lab.closeLoop(old);
  EXPECT_EQ(lab.walls(), static_cast<std::size_t>(kWallsOfSixRooms));
  EXPECT_GE(lab.observations(), sightings_before) << "no sighting is lost";
}

/// Two faces in a row, one 0.25 m behind the other, and never both in sight: a step that is hardly
/// known and slips by as much makes them one, and the loop shows that they are two.
TEST(WallLayer, AWallThatWasTwoIsSplitWhenTheLoopIsClosed) {
  PlaneWorld world;
  world.range_m = 3.0;
  world.faces.push_back(Face{{6.0, 2.0}, {0.0, 2.0}, {}});
  world.faces.push_back(Face{{13.0, 2.25}, {7.0, 2.25}, {}});
  WallLab lab(world);
  for (double x = 0.5; x < 4.6; x += 0.5) lab.step(poseAt(x, 0.0));
  lab.step(poseAt(9.5, 0.0), Pose(Eigen::Translation3d(0.0, -0.25, 0.0)));
  for (double x = 10.0; x < 12.6; x += 0.5) lab.step(poseAt(x, 0.0));
  EXPECT_EQ(lab.walls(), 1U);
  lab.closeLoop(0);
  EXPECT_EQ(lab.walls(), 2U);
  EXPECT_EQ(lab.wallsOnFaces().count(-1), 0U);
  EXPECT_LT(lab.meanChi2(), 4.0);
}

/// The odometry has slipped by a metre and knows of it: the shelf, seen with the wall, is not taken
/// for the wall, however wide the gate.
TEST(WallLayer, DriftMakesNoWallOfAShelf) {
  for (const double slip_m : {0.25, 0.4, 1.0}) {
    SCOPED_TRACE(slip_m);
    PlaneWorld world;
    world.faces.push_back(Face{{12.0, 3.0}, {0.0, 3.0}, {}});
    world.faces.push_back(Face{{6.0, 2.6}, {4.0, 2.6}, {}, 0.0, 1.8});
    WallLab lab(world);
    for (double x = 1.0; x < 9.0; x += 0.5) lab.step(poseAt(x, 0.0));
    for (double x = 9.0; x > 2.0; x -= 0.5) {
      lab.step(poseAt(x, 0.0),
               x == 9.0 ? Pose(Eigen::Translation3d(0.0, slip_m, 0.0)) : Pose::Identity());
    }
    lab.closeLoop(2);
    lab.closeLoop(2);
    EXPECT_EQ(lab.walls(), 2U);
    EXPECT_EQ(lab.wallsOnFaces().count(-1), 0U);
  }
}

/// Planes that no segmentation should give.
TEST(WallLayer, UnsoundPlanesAreLeftOut) {
  WallLab lab(test::sixRooms());
  for (int k = 0; k < 4; ++k) lab.step(poseAt(2.0 + 0.1 * k, 2.0));
  const std::size_t walls = lab.walls();
  KeyframeAttributes attributes = lab.graph.attributes(lab.newest());
  auto planes = std::make_shared<ObservedPlanes>(*attributes.planes);
  ASSERT_GE(planes->size(), 4U);
  (*planes)[0].covariance.setZero();
  (*planes)[1].plane_base.distance = std::nan("");
  (*planes)[2].extent_base.outline.clear();
  (*planes)[3].plane_base.normal *= 2.0;
  attributes.planes = planes;
  const std::size_t sightings = lab.observations();
  lab.way.update(lab.graph);
  const KeyframeId odd = lab.graph.addKeyframe(lab.graph.pose(lab.newest()), attributes);
  lab.graph.addFactor(std::make_shared<RelativePoseFactor>(lab.newest(), odd, Pose::Identity(),
                                                           Matrix6::Identity(),
                                                           RelativePoseFactor::Kind::kOdometry));
  lab.way.update(lab.graph);
  EXPECT_NO_THROW(lab.layer.associate(lab.way, &lab.graph));
  EXPECT_EQ(lab.walls(), walls);
  EXPECT_LE(lab.observations(), sightings + planes->size() - 4);
}

}  // namespace
}  // namespace mrpt_sgraphs
