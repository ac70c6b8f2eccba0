// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/levelling.h"

#include <gtest/gtest.h>

#include "support/random_geometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

/// Cells of a plane through `centre`, a metre apart in two directions.
std::vector<MapPlane> tiles(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, int side) {
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  std::vector<MapPlane> planes;
  for (int a = -side; a <= side; ++a) {
    for (int b = -side; b <= side; ++b) planes.push_back({centre + a * u + b * v, normal, 1e-4});
  }
  return planes;
}

void append(const std::vector<MapPlane>& more, std::vector<MapPlane>* planes) {
  planes->insert(planes->end(), more.begin(), more.end());
}

/// A hall in its own level frame: floor, ceiling, a table and four walls.
std::vector<MapPlane> hall() {
  std::vector<MapPlane> planes = tiles({0.0, 0.0, -1.0}, Eigen::Vector3d::UnitZ(), 2);
  append(tiles({0.0, 0.0, 1.8}, -Eigen::Vector3d::UnitZ(), 4), &planes);
  append(tiles({1.5, 1.0, -0.3}, Eigen::Vector3d::UnitZ(), 1), &planes);
  for (const double side : {-1.0, 1.0}) {
    append(tiles({side * 4.0, 0.0, 0.4}, -side * Eigen::Vector3d::UnitX(), 3), &planes);
    append(tiles({0.0, side * 4.0, 0.4}, -side * Eigen::Vector3d::UnitY(), 3), &planes);
  }
  return planes;
}

/// The planes as a robot sees them that is turned by R_level_base.
std::vector<MapPlane> seenFrom(const Eigen::Matrix3d& R_level_base, std::vector<MapPlane> planes) {
  for (MapPlane& plane : planes) {
    plane.centre = R_level_base.transpose() * plane.centre;
    plane.normal = R_level_base.transpose() * plane.normal;
  }
  return planes;
}

TEST(Levelling, FindsTheGroundHoweverTheRobotIsTilted) {
  test::RandomGeometry random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d axis(random.number(1.0), random.number(1.0), 0.0);
    const double tilt_rad = random.number(25.0) * kRadPerDeg;
    SCOPED_TRACE(testing::Message() << tilt_rad << " rad about " << axis.transpose());
    const Eigen::Matrix3d R_tilt = expSO3(tilt_rad * axis.normalized());
    const Eigen::Matrix3d R_turn = expSO3(random.number(M_PI) * Eigen::Vector3d::UnitZ());
    const Eigen::Matrix3d R_level_base =
        levelFromGround(seenFrom(R_tilt, seenFrom(R_turn, hall())));
    // the tilt is undone, and nothing is turned about the vertical
    EXPECT_LT(logSO3(R_level_base.transpose() * R_tilt).norm(), 1e-9);
  }
}

TEST(Levelling, LeavesTheRobotAsItIsWhereThereIsNoGround) {
  std::vector<MapPlane> without_ground;
  for (const MapPlane& plane : hall()) {
    if (plane.normal.z() < 0.5) without_ground.push_back(plane);
  }
  const Eigen::Matrix3d R_tilt = expSO3({0.1, -0.2, 0.0});
  EXPECT_TRUE(levelFromGround(seenFrom(R_tilt, without_ground)).isIdentity(0.0));
  EXPECT_TRUE(levelFromGround({}).isIdentity(0.0));

  const std::vector<MapPlane> step(3, {{0.5, 0.0, -0.8}, Eigen::Vector3d::UnitZ(), 1e-4});
  EXPECT_TRUE(levelFromGround(seenFrom(R_tilt, step)).isIdentity(0.0)) << "too few";
}

TEST(Levelling, TakesNothingSteepForGround) {
  const Eigen::Matrix3d R_steep = expSO3({35.0 * kRadPerDeg, 0.0, 0.0});
  const auto ramp = tiles({0.0, 0.0, -1.0}, Eigen::Vector3d::UnitZ(), 3);
  EXPECT_TRUE(levelFromGround(seenFrom(R_steep, ramp)).isIdentity(0.0));
}

TEST(Levelling, LevelsAFirstScan) {
  const test::ScanStage stage(sim::test::shipped("small"), sim::lidarNamed("os1_64"));
  const Cloud::Ptr scan = stage.scan({{2.2, 4.2}}).cloud;
  for (const double tilt_deg : {0.0, 3.0, 6.0, 10.0, 15.0, 20.0, 25.0}) {
    const Eigen::Matrix3d R_level_base =
        expSO3(tilt_deg * kRadPerDeg * Eigen::Vector3d(0.6, 0.8, 0.0));
    const Eigen::Vector3d viewpoint =
        R_level_base.transpose() * scan->sensor_origin_.head<3>().cast<double>();
    VoxelMap map(VoxelMapConfig{});
    for (const Point& point : *scan) {
      map.insert(R_level_base.transpose() * point.getVector3fMap().cast<double>(), viewpoint);
    }
    map.refit();
    const Eigen::Matrix3d error = levelFromGround(map.planes(0)).transpose() * R_level_base;
    EXPECT_LT(logSO3(error).norm(), 1.0 * kRadPerDeg) << "tilted by " << tilt_deg << " degrees";
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
