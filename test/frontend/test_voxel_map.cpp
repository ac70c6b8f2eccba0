// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kEdge_m = 0.5;

VoxelMapConfig config() {
  VoxelMapConfig config;
  config.voxel_size_m = kEdge_m;
  return config;
}

/// A stretch of wall: points on a grid in the plane through `centre`, with noise along its normal.
struct Wall {
  Eigen::Vector3d centre;
  Eigen::Vector3d normal;
  double half_width_m = 0.2;
  double sigma_m = 0.005;
  unsigned seed = 1;

  std::vector<Eigen::Vector3d> points() const {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, sigma_m);
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    constexpr int kSide = 10;
    std::vector<Eigen::Vector3d> points;
    for (int a = 0; a <= kSide; ++a) {
      for (int b = 0; b <= kSide; ++b) {
        points.push_back(centre + half_width_m * (2.0 * a / kSide - 1.0) * u +
                         half_width_m * (2.0 * b / kSide - 1.0) * v + noise(generator) * normal);
      }
    }
    return points;
  }
};

void insert(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& viewpoint,
            VoxelMap* map, double now = 0.0) {
  for (const Eigen::Vector3d& point : points) map->insert(point, viewpoint, now);
}

/// The middle of a cell at about `place`.
Eigen::Vector3d cellMiddle(const Eigen::Vector3d& place) {
  return ((place.array() / kEdge_m).floor() + 0.5) * kEdge_m;
}

void expectSame(const std::vector<MapPlane>& a, const std::vector<MapPlane>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].centre, b[k].centre) << k;
    ASSERT_EQ(a[k].normal, b[k].normal) << k;
    ASSERT_EQ(a[k].variance_m2, b[k].variance_m2) << k;
  }
}

TEST(VoxelMap, FindsAPlaneWhereverItIsAndTurnsItToTheViewer) {
  test::RandomGeometry random(2, 40.0);
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(trial);
    const Eigen::Vector3d centre = cellMiddle(random.vector(40.0));
    const Eigen::Vector3d normal = random.vector(1.0).normalized();
    const Eigen::Vector3d viewpoint = centre + 4.0 * normal + random.vector(1.0);
    const Wall wall{centre, normal};
    VoxelMap map(config());
    insert(wall.points(), viewpoint, &map);
    EXPECT_EQ(map.find(centre, viewpoint, 0), nullptr) << "before it is fitted";
    map.refit();

    const MapPlane* plane = map.find(centre + 0.02 * normal, viewpoint, 0);
    ASSERT_NE(plane, nullptr);
    EXPECT_GT(plane->normal.dot(normal), std::cos(0.02));
    EXPECT_LT(std::abs(normal.dot(plane->centre - centre)), 0.003);
    EXPECT_LT((plane->centre - centre).norm(), 0.05);
    EXPECT_NEAR(std::sqrt(plane->variance_m2), wall.sigma_m, 0.3 * wall.sigma_m);
    // nobody sees it from behind, and nothing is beyond it
    EXPECT_EQ(map.find(centre, centre - 4.0 * normal, 0), nullptr);
    EXPECT_EQ(map.find(centre + Eigen::Vector3d(50.0, 0.0, 0.0), viewpoint, 0), nullptr);
  }
}

TEST(VoxelMap, KeepsTheTwoFacesOfAThinWallApart) {
  const Eigen::Vector3d near_side(0.0, 1.2, 1.2);
  const Eigen::Vector3d far_side(4.0, 1.2, 1.2);
  const auto near_face = Wall{{2.2, 1.2, 1.2}, Eigen::Vector3d::UnitX()}.points();
  auto far_face = Wall{{2.3, 1.2, 1.2}, Eigen::Vector3d::UnitX()}.points();
  std::reverse(far_face.begin(), far_face.end());
  for (const std::size_t at_once : {1U, 7U, 1000U}) {  // the robot looks from both sides in turn
    for (const bool refit_between : {true, false}) {
      SCOPED_TRACE(testing::Message() << at_once << (refit_between ? ", refitted" : ""));
      VoxelMap map(config());
      for (std::size_t i = 0; i < near_face.size(); i += at_once) {
        for (std::size_t k = i; k < std::min(i + at_once, near_face.size()); ++k) {
          map.insert(near_face[k], near_side);
        }
        for (std::size_t k = i; k < std::min(i + at_once, far_face.size()); ++k) {
          map.insert(far_face[k], far_side);
        }
        if (refit_between) map.refit();
      }
      map.refit();
      for (int level = 0; level < 2; ++level) {  // for the third the stretch is too small
        ASSERT_EQ(map.planes(level).size(), 2U) << level;
        const MapPlane* near_plane = map.find({2.3, 1.2, 1.2}, near_side, level);
        const MapPlane* far_plane = map.find({2.2, 1.2, 1.2}, far_side, level);
        ASSERT_NE(near_plane, nullptr);
        ASSERT_NE(far_plane, nullptr);
        EXPECT_NEAR(near_plane->centre.x(), 2.2, 0.003);
        EXPECT_NEAR(far_plane->centre.x(), 2.3, 0.003);
        EXPECT_LT(near_plane->normal.x(), -0.999);
        EXPECT_GT(far_plane->normal.x(), 0.999);
      }
    }
  }
}

TEST(VoxelMap, MakesNoPlaneOfOneRing) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  VoxelMap map(config());
  for (int scan = 0; scan < 20; ++scan) {  // a robot that stands
    for (int k = 0; k < 200; ++k) {
      const double y = -2.0 + 0.02 * k;
      map.insert({3.0 + noise(generator), y, 0.8 + noise(generator)}, {0.0, 0.0, 0.5});
    }
    map.refit();
  }
  for (int level = 0; level < VoxelMap::kLevels; ++level) EXPECT_TRUE(map.planes(level).empty());
}

TEST(VoxelMap, MakesNoPlaneOfOneBeamAroundACorner) {
  // two walls meet at (x, y) = (2.2, 2.2); a beam draws an L on them, in a plane through the sensor
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.005);
  const Eigen::Vector3d sensor(0.0, 0.0, 0.6);
  for (const double elevation_rad : {-0.26, -0.05, 0.09, 0.26}) {
    SCOPED_TRACE(elevation_rad);
    VoxelMap map(config());
    for (double azimuth_rad = 0.3; azimuth_rad < 1.27; azimuth_rad += 0.002) {
      const double wall_m =
          std::min(2.2 / std::cos(azimuth_rad), 2.2 / std::sin(azimuth_rad)) + noise(generator);
      map.insert(sensor + wall_m * Eigen::Vector3d(std::cos(azimuth_rad), std::sin(azimuth_rad),
                                                   std::tan(elevation_rad)),
                 sensor);
    }
    map.refit();
    for (int level = 0; level < VoxelMap::kLevels; ++level) {
      EXPECT_TRUE(map.planes(level).empty()) << "level " << level;
    }
  }
}

TEST(VoxelMap, KeepsAFloorSeenFromALowSensor) {
  VoxelMap map(config());
  insert(Wall{{6.25, 0.25, 0.2}, Eigen::Vector3d::UnitZ()}.points(), {0.25, 0.25, 0.8}, &map);
  map.refit();
  const auto planes = map.planes(0);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_GT(planes.front().normal.z(), 0.99);
}

TEST(VoxelMap, PlanesReachNoFartherThanTheirPoints) {
  // a stretch of floor, and a coarse cell about it that reaches over a wall
  const Eigen::Vector3d viewpoint(0.3, 0.3, 1.2);
  VoxelMap map(config());
  insert(Wall{{0.25, 0.25, 0.1}, Eigen::Vector3d::UnitZ()}.points(), viewpoint, &map);
  map.refit();
  ASSERT_EQ(map.planes(1).size(), 1U);
  constexpr double kFootOfAWall_m = 0.12;
  EXPECT_NE(map.find({0.25, 0.25, kFootOfAWall_m}, viewpoint, 0), nullptr) << "among its points";
  EXPECT_NE(map.find({0.55, 0.25, kFootOfAWall_m}, viewpoint, 0), nullptr) << "next to them";
  EXPECT_EQ(map.find({1.25, 0.25, kFootOfAWall_m}, viewpoint, 0), nullptr) << "past them";
  EXPECT_EQ(map.find({0.25, 1.25, kFootOfAWall_m}, viewpoint, 0), nullptr) << "the other way";
  EXPECT_NE(map.find({1.25, 0.25, kFootOfAWall_m}, viewpoint, 1), nullptr) << "while searching";
}

TEST(VoxelMap, MakesNoPlaneOfWhatIsThick) {
  test::RandomGeometry random(4);
  VoxelMap map(config());
  for (int k = 0; k < 2000; ++k) {  // a plant
    map.insert(Eigen::Vector3d(0.25, 0.25, 0.25) + random.vector(0.24), {5.0, 0.0, 0.0});
  }
  map.refit();
  EXPECT_EQ(map.cells(), 1U);
  EXPECT_TRUE(map.planes(0).empty());
}

TEST(VoxelMap, NeedsAsManyPointsAsItIsTold) {
  const auto points = Wall{{0.25, 0.25, 0.25}, Eigen::Vector3d::UnitZ()}.points();
  VoxelMapConfig sparse = config();
  sparse.min_points = 12;
  VoxelMap map(sparse);
  for (int k = 0; k < 12; ++k) {
    EXPECT_TRUE(map.planes(0).empty()) << k;
    map.insert(points[static_cast<std::size_t>(k * 37 % 121)], {0.0, 0.0, 3.0});
    map.refit();
  }
  EXPECT_EQ(map.planes(0).size(), 1U);
}

TEST(VoxelMap, DoesNotCreepOnceAPlaneIsKnown) {
  const Eigen::Vector3d viewpoint(0.2, 0.2, 3.0);
  VoxelMap map(config());
  insert(Wall{{0.25, 0.25, 0.2}, Eigen::Vector3d::UnitZ()}.points(), viewpoint, &map);
  map.refit();
  const auto known = map.planes(0);
  ASSERT_EQ(known.size(), 1U);
  for (unsigned seed = 2; seed < 50; ++seed) {
    insert(Wall{{0.25, 0.25, 0.24}, Eigen::Vector3d::UnitZ(), 0.2, 0.005, seed}.points(), viewpoint,
           &map);
    map.refit();
  }
  expectSame(map.planes(0), known);
}

TEST(VoxelMap, TakesACoarserCellWhereAFineOneSaysNothing) {
  const Eigen::Vector3d viewpoint(2.2, 2.2, 5.0);
  VoxelMap map(config());
  // 2 x 2 m with one point in a fine cell, and a fine cell that is full
  std::vector<Eigen::Vector3d> points = Wall{{0.25, 0.25, 0.2}, Eigen::Vector3d::UnitZ()}.points();
  for (double x = 1.75; x < 4.4; x += kEdge_m) {
    for (double y = 1.75; y < 4.4; y += kEdge_m) points.emplace_back(x, y, 0.3);
  }
  insert(points, viewpoint, &map);
  map.refit();
  EXPECT_EQ(map.planes(0).size(), 1U);
  const MapPlane* coarse = map.find({2.25, 2.25, 0.35}, viewpoint, 0);
  ASSERT_NE(coarse, nullptr);
  EXPECT_NEAR(coarse->centre.z(), 0.3, 1e-9);
  // near the full cell the pose decides: first the finest, or first the coarsest
  const Eigen::Vector3d there(0.25, 0.25, 0.2);
  EXPECT_NEAR(map.find(there, viewpoint, 0)->centre.x(), 0.25, 0.05);
  EXPECT_EQ(map.find(there, viewpoint, 2), map.find({3.0, 3.0, 0.2}, viewpoint, 2));
}

TEST(VoxelMap, ForgetsWhatIsFarAndWhatIsOld) {
  const Eigen::Vector3d up(0.0, 0.0, 3.0);
  const Eigen::Vector3d near_by(0.25, 0.25, 0.25);
  const Eigen::Vector3d far_away(20.25, 0.25, 0.25);
  const auto filled = [&] {
    VoxelMap map(config());
    insert(Wall{near_by, Eigen::Vector3d::UnitZ()}.points(), near_by + up, &map, 1.0);
    insert(Wall{far_away, Eigen::Vector3d::UnitZ()}.points(), far_away + up, &map, 5.0);
    map.refit();
    return map;
  };
  VoxelMap map = filled();
  map.forget({0.0, 0.0, 0.0}, 30.0, 1.0);
  EXPECT_EQ(map.cells(), 2U) << "neither";
  map.forget({0.0, 0.0, 0.0}, 10.0, 0.0);
  EXPECT_EQ(map.cells(), 1U) << "by radius";
  EXPECT_NE(map.find(near_by, near_by + up, 0), nullptr);
  EXPECT_EQ(map.find(far_away, far_away + up, 0), nullptr);

  map = filled();
  map.forget({0.0, 0.0, 0.0}, 100.0, 2.0);
  EXPECT_EQ(map.cells(), 1U) << "by age";
  EXPECT_EQ(map.find(near_by, near_by + up, 0), nullptr);
  EXPECT_NE(map.find(far_away, far_away + up, 0), nullptr);
  map.insert(far_away, far_away + up, 9.0);  // one look keeps it
  map.forget({0.0, 0.0, 0.0}, 100.0, 8.0);
  EXPECT_EQ(map.cells(), 1U);
  map.forget({0.0, 0.0, 0.0}, 100.0, 10.0);
  EXPECT_TRUE(map.empty());
}

TEST(VoxelMap, MayForgetCellsThatWaitToBeFitted) {
  VoxelMap map(config());
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector3d centre(10.0 * k + 0.25, 0.25, 0.25);
    insert(Wall{centre, Eigen::Vector3d::UnitZ()}.points(), {centre.x(), 0.0, 3.0}, &map);
    map.forget(centre, 15.0, 0.0);
  }
  map.refit();
  EXPECT_EQ(map.cells(), 2U);
  EXPECT_EQ(map.planes(0).size(), 2U);
}

TEST(VoxelMap, OrderOfPlanesDoesNotDependOnHashing) {
  std::vector<Eigen::Vector3d> centres;
  for (int k = 0; k < 300; ++k) {
    centres.push_back(
        cellMiddle({0.5 * (k * 7 % 31) - 8.0, 0.5 * (k * 11 % 29) - 7.0, 0.5 * (k % 5)}));
  }
  const auto mapOf = [&](const std::vector<Eigen::Vector3d>& order, double first_forgotten_m) {
    VoxelMap map(config());
    // a table that has been larger hashes otherwise
    for (double x = 0.0; x < first_forgotten_m; x += kEdge_m) {
      map.insert({1000.0 + x, 0.0, 0.0}, {1000.0, 0.0, 3.0});
    }
    map.forget({0.0, 0.0, 0.0}, 500.0, 0.0);
    for (const Eigen::Vector3d& centre : order) {
      insert(Wall{centre, Eigen::Vector3d::UnitZ()}.points(), centre + Eigen::Vector3d(0, 0, 3),
             &map);
    }
    map.refit();
    return map.planes(0);
  };
  const auto planes = mapOf(centres, 0.0);
  EXPECT_GT(planes.size(), 100U);
  expectSame(planes, mapOf(centres, 3000.0));
  std::vector<Eigen::Vector3d> backwards(centres.rbegin(), centres.rend());
  const auto reordered = mapOf(backwards, 0.0);
  ASSERT_EQ(reordered.size(), planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    EXPECT_EQ(cellMiddle(reordered[k].centre), cellMiddle(planes[k].centre));
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
