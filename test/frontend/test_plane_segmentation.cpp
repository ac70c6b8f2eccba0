// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/plane_segmentation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "support/flat_world.h"

namespace mrpt_sgraphs {
namespace {

using test::FlatWorld;
using test::Pattern;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180.0;
constexpr double kNoise_m = 0.01;

Pattern vlp16() { return Pattern::spinning(16, 1800, -15.0 * kDegree, 15.0 * kDegree); }

Pose at(double x, double y, double z, double yaw = 0.3, double pitch = 0.02) {
  Pose T = Pose::Identity();
  T.translation() << x, y, z;
  T.linear() = (Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Vector3d::UnitY()))
                   .toRotationMatrix();
  return T;
}

/// A segment in the world's frame.
struct Seen {
  Plane plane;
  Vector3d centroid;
  PlaneSegment segment;
};

std::vector<Seen> seenFrom(const FlatWorld& world, const Pattern& pattern, const Pose& T_world_base,
                           const PlaneSegmentationConfig& config = {}, double noise_m = kNoise_m,
                           unsigned seed = 1) {
  std::mt19937 random(seed);
  const Cloud cloud = test::scanOf(world, pattern, T_world_base, noise_m, &random);
  std::vector<Seen> seen;
  for (const PlaneSegment& segment : segmentPlanes(gatheredFrom(cloud), config)) {
    seen.push_back({T_world_base * segment.plane_base, T_world_base * segment.centroid_base,
                    segment});
  }
  return seen;
}

/// Those that lie on the plane and were seen from the side of `normal`.
std::vector<Seen> on(const Vector3d& normal, double distance, const std::vector<Seen>& all) {
  std::vector<Seen> found;
  for (const Seen& seen : all) {
    if (seen.plane.normal.dot(normal) > std::cos(2.0 * kDegree) &&
        std::abs(normal.dot(seen.centroid) - distance) < 0.03) {
      found.push_back(seen);
    }
  }
  return found;
}

double holeArea(const PlanarExtent& extent) {
  double area = 0.0;
  for (const Outline3& hole : extent.holes) {
    Vector3d twice = Vector3d::Zero();
    for (std::size_t k = 0; k < hole.size(); ++k) {
      twice += (hole[k] - hole[0]).cross(hole[(k + 1) % hole.size()] - hole[0]);
    }
    area += 0.5 * twice.norm();
  }
  return area;
}

const FlatWorld kRoom = FlatWorld::box({-3, -2, 0}, {4, 2.5, 2.8});

void expectSurfacesOfRoom(const std::vector<Seen>& seen, bool floor_and_ceiling) {
  EXPECT_EQ(on(Vector3d::UnitX(), -3.0, seen).size(), 1U);
  EXPECT_EQ(on(-Vector3d::UnitX(), -4.0, seen).size(), 1U);
  EXPECT_EQ(on(Vector3d::UnitY(), -2.0, seen).size(), 1U);
  EXPECT_EQ(on(-Vector3d::UnitY(), -2.5, seen).size(), 1U);
  if (!floor_and_ceiling) return;
  EXPECT_EQ(on(Vector3d::UnitZ(), 0.0, seen).size(), 1U);
  EXPECT_EQ(on(-Vector3d::UnitZ(), -2.8, seen).size(), 1U);
}

TEST(PlaneSegmentation, FindsTheSurfacesOfARoomOnceAndNothingElse) {
  const auto sparse = seenFrom(kRoom, vlp16(), at(0, 0, 1.2));
  expectSurfacesOfRoom(sparse, false);
  const Pattern wide = Pattern::spinning(128, 1024, -45 * kDegree, 45 * kDegree);
  const auto dense = seenFrom(kRoom, wide, at(0.4, -0.3, 1.0));
  expectSurfacesOfRoom(dense, true);
  EXPECT_EQ(dense.size(), 6U);
}

TEST(PlaneSegmentation, NeedsNeitherRingsNorAnOrder) {
  std::mt19937 random(4);
  Cloud cloud = test::scanOf(kRoom, vlp16(), at(0, 0, 1.2), kNoise_m, &random);
  for (Point& point : cloud) point.ring = 0;
  std::shuffle(cloud.begin(), cloud.end(), random);
  std::vector<Seen> seen;
  for (const PlaneSegment& s : segmentPlanes(gatheredFrom(cloud), {})) {
    seen.push_back({at(0, 0, 1.2) * s.plane_base, at(0, 0, 1.2) * s.centroid_base, s});
  }
  expectSurfacesOfRoom(seen, false);
}

TEST(PlaneSegmentation, SeesWhatASolidStateSensorLooksAt) {
  const auto seen = seenFrom(kRoom, Pattern::rosette(24000, 35 * kDegree), at(-1, 0, 1.2, 0.0));
  EXPECT_EQ(on(-Vector3d::UnitX(), -4.0, seen).size(), 1U);
}

TEST(PlaneSegmentation, IndicesArePointsOfThePlaneAndOfOneOnly) {
  std::mt19937 random(5);
  const Pose T = at(0, 0, 1.2);
  const Cloud cloud = test::scanOf(kRoom, vlp16(), T, kNoise_m, &random);
  std::set<int> all;
  for (const PlaneSegment& segment : segmentPlanes(gatheredFrom(cloud), {})) {
    EXPECT_EQ(segment.points, static_cast<int>(segment.indices.size()));
    for (const int index : segment.indices) {
      EXPECT_TRUE(all.insert(index).second);
      const Vector3d p =
          cloud[static_cast<std::size_t>(index)].getVector3fMap().cast<double>();
      EXPECT_LT(std::abs(segment.plane_base.normal.dot(p) - segment.plane_base.distance), 0.06);
    }
  }
  EXPECT_GT(static_cast<double>(all.size()), 0.9 * static_cast<double>(cloud.size()));
}

TEST(PlaneSegmentation, TheResultTurnsWithTheScan) {
  std::mt19937 random(6);
  const Cloud cloud = test::scanOf(kRoom, vlp16(), at(0, 0, 1.2), kNoise_m, &random);
  const std::size_t count = segmentPlanes(gatheredFrom(cloud), {}).size();
  for (const double yaw : {17.0 * kDegree, 45.0 * kDegree, 2.0}) {
    Cloud turned = cloud;
    const Eigen::Matrix3f R = Eigen::AngleAxisf(float(yaw), Eigen::Vector3f::UnitZ()).matrix();
    for (Point& p : turned) p.getVector3fMap() = R * p.getVector3fMap();
    EXPECT_EQ(segmentPlanes(gatheredFrom(turned), {}).size(), count);
  }
}

/// A wall along x at y = 3 with an opening from x = 0 on.
std::vector<Seen> wallWithOpening(double width_m, double lintel_m) {
  FlatWorld world;
  const Vector3d up(0, 0, 2.8);
  world.rectangles = {{{-4, 3, 0}, {4, 0, 0}, up}, {{width_m, 3, 0}, {4, 0, 0}, up}};
  if (lintel_m > 0.0) {
    world.rectangles.push_back({{0, 3, 2.8 - lintel_m}, {width_m, 0, 0}, {0, 0, lintel_m}});
  }
  const Pattern pattern = Pattern::spinning(64, 1800, -35 * kDegree, 35 * kDegree);
  return on(-Vector3d::UnitY(), -3.0, seenFrom(world, pattern, at(0.5, 0, 1.2)));
}

TEST(PlaneSegmentation, ADoorIsAHoleAndAWideGapMakesTwo) {
  for (const double lintel_m : {0.0, 0.7}) {
    const auto with_door = wallWithOpening(1.0, lintel_m);
    ASSERT_EQ(with_door.size(), 1U) << lintel_m;
    EXPECT_NEAR(holeArea(with_door[0].segment.extent_base), 2.8 - lintel_m, 0.4) << lintel_m;
  }
  EXPECT_EQ(wallWithOpening(2.2, 0.0).size(), 2U);
}

TEST(PlaneSegmentation, TheFacesOfAThinWallAreTwo) {
  // seen from either side on the way through a door at its end
  FlatWorld world;
  const Vector3d up(0, 0, 2.8);
  world.rectangles = {{{0, 0.03, 0}, {5, 0, 0}, up}, {{0, -0.03, 0}, {5, 0, 0}, up}};
  std::mt19937 random(7);
  GatheredPoints points;
  for (const double y : {-1.5, 1.5}) {
    const Pose T = at(2, y, 1.2, 0.0, 0.0);
    points.views.push_back({points.cloud.size(), T.translation()});
    for (Point p : test::scanOf(world, vlp16(), T, 0.006, &random)) {
      p.getVector3fMap() = (T * Vector3d(p.getVector3fMap().cast<double>())).cast<float>();
      points.cloud.push_back(p);
    }
  }
  std::vector<Seen> seen;
  for (const PlaneSegment& s : segmentPlanes(points, {})) {
    seen.push_back({s.plane_base, s.centroid_base, s});
  }
  ASSERT_EQ(on(Vector3d::UnitY(), 0.03, seen).size(), 1U);
  ASSERT_EQ(on(-Vector3d::UnitY(), 0.03, seen).size(), 1U);
  EXPECT_NEAR(on(Vector3d::UnitY(), 0.03, seen)[0].plane.distance, 0.03, 0.004);
  EXPECT_NEAR(on(-Vector3d::UnitY(), 0.03, seen)[0].plane.distance, 0.03, 0.004);
}

TEST(PlaneSegmentation, PillarsAndClutterAreNoPlanes) {
  for (const double radius_m : {0.15, 0.4, 1.0, 2.0}) {
    FlatWorld pillars;
    for (const double x : {-6.0, 0.0, 6.0}) pillars.pillars.push_back({{x, 4.0}, radius_m});
    EXPECT_TRUE(seenFrom(pillars, vlp16(), at(0, 0, 1.2)).empty()) << radius_m;
  }

  std::mt19937 random(8);
  std::uniform_real_distribution<float> spread(-1.0F, 1.0F);
  Cloud clutter;
  for (int k = 0; k < 20000; ++k) {
    Point p;
    p.getVector3fMap() << 4.0F + 2.0F * spread(random), 2.0F * spread(random),
        1.5F + 1.5F * spread(random);
    clutter.push_back(p);
  }
  EXPECT_TRUE(segmentPlanes(gatheredFrom(clutter), {}).empty());
}

TEST(PlaneSegmentation, NoPointsAreNoPlanes) {
  EXPECT_TRUE(segmentPlanes(gatheredFrom(Cloud()), {}).empty());
  Cloud one;
  one.push_back(Point());
  EXPECT_TRUE(segmentPlanes(gatheredFrom(one), {}).empty());
}

/// Mean of the errors squared over their covariances, 3 degrees of freedom, of walls at random
/// distances and angles.
double meanNees(const PlaneSegmentationConfig& config, int planes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 100; count < planes && seed < 100U + 2U * static_cast<unsigned>(planes); ++seed) {
    const double distance_m = 1.0 + 7.0 * uniform(random);
    const double length_m = 1.5 + 8.0 * uniform(random);
    const double shift_m = (uniform(random) - 0.5) * length_m;
    FlatWorld world;
    world.rectangles = {{{shift_m - 0.5 * length_m, distance_m, 0}, {length_m, 0, 0}, {0, 0, 2.8}}};
    const Pose T = at(0, 0, 1.2, 6.3 * uniform(random), 0.05 * uniform(random));
    const auto seen = seenFrom(world, vlp16(), T, config, 0.015, seed);
    if (seen.size() != 1U) continue;
    const PlaneSegment& segment = seen[0].segment;
    const Plane truth = inverseTimes(T, Plane{-Vector3d::UnitY(), -distance_m});
    const PlaneTangent error = local(segment.plane_base, truth);
    sum += error.dot(segment.covariance.inverse() * error);
    ++count;
  }
  EXPECT_EQ(count, planes);
  return sum / count;
}

TEST(PlaneSegmentation, CovariancesAreHonest) {
  PlaneSegmentationConfig scatter_alone;
  scatter_alone.systematic_m = scatter_alone.systematic_rad = 0.0;
  const double nees = meanNees(scatter_alone, 1000);
  const double with_floor = meanNees({}, 1000);
  RecordProperty("nees", std::to_string(nees));
  RecordProperty("nees_with_floor", std::to_string(with_floor));
  std::printf("NEES: %.3f from the scatter alone, %.3f with the systematic error\n", nees, with_floor);
  EXPECT_GT(nees, 2.5);
  EXPECT_LT(nees, 3.5);
  EXPECT_LE(with_floor, 3.0);
}

}  // namespace
}  // namespace mrpt_sgraphs
