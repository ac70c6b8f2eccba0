// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/scene.h"
#include "sim/seen_walls.h"
#include "sim/truth.h"
#include "sim/wall_faces.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kCellArea_m2 = SeenWalls::kCell_m * SeenWalls::kCell_m;

/// Rays in a building, and what is seen by them.
class SeenWallsTest : public ::testing::Test {
 protected:
  explicit SeenWallsTest(const std::string& yaml = test::kTwoRooms)
      : building_(test::buildingFrom(yaml)), scene_(building_), seen_(building_) {}

  /// The face that a ray from one point to another ends on.
  int look(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Ray ray{from, (to - from).normalized()};
    const std::optional<Hit> hit = scene_.cast(ray, 100.0, {});
    if (!hit) throw std::logic_error("the ray meets nothing");
    seen_.add(ray, *hit);
    return hit->face;
  }
  double sum_m2() const {
    double sum = 0.0;
    for (size_t k = 0; k < wallFaces(building_).size(); ++k) sum += seen_.area_m2(k);
    return sum;
  }

  Building building_;
  Scene scene_;
  SeenWalls seen_;
};

TEST_F(SeenWallsTest, CountsEverySquareOfAFaceOnce) {
  const Eigen::Vector3d eye(2.0, 2.0, 1.5);
  const int south = look(eye, {2.1, 0.0, 1.1});
  ASSERT_NE(south, kNoFace);
  EXPECT_NEAR(wallFaces(building_)[static_cast<size_t>(south)].inward().y(), 1.0, 1e-12);
  EXPECT_EQ(look(eye, {2.15, 0.0, 1.15}), south);  // the same square
  EXPECT_NEAR(seen_.area_m2(static_cast<size_t>(south)), kCellArea_m2, 1e-12);
  EXPECT_EQ(look(eye, {2.3, 0.0, 1.1}), south);  // the next
  EXPECT_NEAR(seen_.area_m2(static_cast<size_t>(south)), 2.0 * kCellArea_m2, 1e-12);
  EXPECT_NEAR(sum_m2(), 2.0 * kCellArea_m2, 1e-12);
}

TEST_F(SeenWallsTest, JambsLintelsPanesFloorsAndCeilingsAreNoWall) {
  const Eigen::Vector3d eye(2.0, 2.0, 1.5);
  EXPECT_EQ(look({4.0, 2.0, 1.5}, {5.1, 2.5, 1.5}), kNoFace);  // jamb
  EXPECT_EQ(look({4.0, 2.0, 0.5}, {5.1, 2.0, 2.0}), kNoFace);  // lintel
  EXPECT_EQ(look(eye, {0.0, 3.0, 1.5}), kNoFace);              // pane
  EXPECT_EQ(look(eye, {2.5, 2.0, 0.0}), kNoFace);
  EXPECT_EQ(look(eye, {2.5, 2.0, 3.0}), kNoFace);
  EXPECT_EQ(sum_m2(), 0.0);
  EXPECT_NE(look(eye, {0.0, 3.0, 2.5}), kNoFace);  // above the window
}

TEST_F(SeenWallsTest, ThroughADoorTheFaceBehindItIsSeen) {
  const int face = look({2.0, 2.0, 1.5}, {9.0, 2.0, 1.5});
  ASSERT_NE(face, kNoFace);
  EXPECT_EQ(wallFaces(building_)[static_cast<size_t>(face)].room, 1U);
  EXPECT_NEAR(sum_m2(), kCellArea_m2, 1e-12);
}

TEST_F(SeenWallsTest, FromAfarNothingIsSeen) {
  const Eigen::Vector3d wall(5.0, 1.0, 1.0);
  Hit hit;
  hit.face = 1;
  hit.range_m = SeenWalls::kNear_m + 0.01;
  seen_.add({wall - hit.range_m * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()}, hit);
  EXPECT_EQ(sum_m2(), 0.0);
  hit.range_m = SeenWalls::kNear_m - 0.01;
  seen_.add({wall - hit.range_m * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()}, hit);
  EXPECT_NEAR(seen_.area_m2(1), kCellArea_m2, 1e-12);
}

class FurnishedTest : public SeenWallsTest {
 protected:
  FurnishedTest()
      : SeenWallsTest(test::replaced(
            test::replaced(test::kTwoRooms, "height_m: 3.0", "height_m: 3.1"),
            "tour:", "    furniture: [{at: [2.0, 0.3], size_m: [1, 0.4, 2]}]\ntour:")) {}
};

TEST_F(FurnishedTest, WhatStandsBeforeAWallIsNoWall) {
  EXPECT_EQ(look({2.0, 2.0, 1.5}, {2.0, 0.0, 1.0}), kNoFace);
  EXPECT_EQ(sum_m2(), 0.0);
  EXPECT_NE(look({2.0, 2.0, 2.5}, {2.0, 0.0, 2.5}), kNoFace);
}

TEST_F(FurnishedTest, AFaceIsNeverSeenToMoreThanItsArea) {
  for (double x = 0.05; x < 5.0; x += 0.1) {
    for (double z = 0.05; z < 3.1; z += 0.1) look({x, 1.0, z}, {x, 4.0, z});
  }
  EXPECT_NEAR(sum_m2(), 5.0 * 3.1, 1e-9);  // the squares under the ceiling are half ones
}

SimulationConfig shortRun() {
  SimulationConfig config;
  config.lidar = lidarNamed("vlp16");
  config.robot = robotNamed("legged");
  config.max_duration_s = 3.0;
  return config;
}

std::vector<LidarScan> scansOf(Simulation& simulation) {
  std::vector<LidarScan> scans;
  MeasurementSink sink;
  sink.imu = [](const ImuSample&) {};
  sink.odometry = [](const OdometrySample&) {};
  sink.scan = [&](const LidarScan& scan) { scans.push_back(scan); };
  simulation.run(sink);
  return scans;
}

std::vector<double> seenIn(const Simulation& simulation) {
  const auto json = nlohmann::json::parse(buildingJson(simulation));
  std::vector<double> seen_m2;
  for (const auto& wall : json.at("walls")) seen_m2.push_back(wall.at("seen_m2"));
  return seen_m2;
}

TEST(SeenInARun, WallsOfTheRoomAreAndThoseOfAnotherStoreyAreNot) {
  Simulation simulation(test::shipped("two_storey"), shortRun());
  for (const double seen_m2 : seenIn(simulation)) EXPECT_EQ(seen_m2, 0.0);  // before the run
  scansOf(simulation);
  const std::vector<double> seen_m2 = seenIn(simulation);
  const std::vector<WallFace> faces = wallFaces(simulation.building());
  const auto start = simulation.building().roomAt(
      0, simulation.trajectory().T_map_base(0.0).translation().head<2>());
  ASSERT_TRUE(start.has_value());
  double in_room_m2 = 0.0;
  for (size_t k = 0; k < faces.size(); ++k) {
    EXPECT_LE(seen_m2[k], faces[k].length_m() * faces[k].height_m + 1e-9);
    if (faces[k].storey == 1) {
      EXPECT_EQ(seen_m2[k], 0.0);
    }
    if (faces[k].room == *start) in_room_m2 += seen_m2[k];
  }
  EXPECT_GT(in_room_m2, 10.0);
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
