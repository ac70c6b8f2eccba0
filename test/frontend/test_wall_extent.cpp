// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/wall_extent.h"

namespace mrpt_sgraphs {
namespace {

/// The wall x = 2, seen from the origin: y runs to the left, z up.
const Plane kWall{-Eigen::Vector3d::UnitX(), -2.0};

PlanarExtent piece(double y0, double y1, double z0 = 0.0, double z1 = 2.5) {
  return {{{2.0, y1, z0}, {2.0, y0, z0}, {2.0, y0, z1}, {2.0, y1, z1}}, {}};
}

WallExtent wallOf(const std::vector<PlanarExtent>& pieces,
                  const Eigen::Vector3d& anchor_map = {2.0, 0.0, 0.0}) {
  WallExtent extent(kWall, anchor_map, 0.1);
  for (const PlanarExtent& one : pieces) extent.add(one);
  return extent;
}

TEST(WallExtent, UnitesWhatWasSeen) {
  const WallExtent wall = wallOf({piece(0.0, 2.0), piece(1.0, 4.0)});
  EXPECT_NEAR(wall.area_m2(), 10.0, 1e-9);
  EXPECT_NEAR((wall.centre_map() - Eigen::Vector3d(2.0, 2.0, 1.25)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(wall.box_map().sizes().y(), 4.0, 1e-9);
  EXPECT_TRUE(wallOf({}).empty());
  EXPECT_TRUE(wallOf({}).box_map().isEmpty());
}

TEST(WallExtent, GapIsAlongTheWallAtOneHeight) {
  const WallExtent wall = wallOf({piece(0.0, 2.0)});
  EXPECT_NEAR(wall.gap_m(wall.drawn(piece(3.2, 5.0))).value(), 1.2, 1e-9);
  EXPECT_NEAR(wall.gap_m(wall.drawn(piece(1.0, 5.0))).value(), 0.0, 1e-9);
  EXPECT_FALSE(wall.gap_m(wall.drawn(piece(0.0, 2.0, 2.8, 5.0)))) << "the storey above";
  EXPECT_NEAR(wall.sharedArea_m2(wall.drawn(piece(1.5, 5.0))), 1.25, 1e-9);
}

TEST(WallExtent, ComparesGridsThatDiffer) {
  const WallExtent wall = wallOf({piece(0.0, 2.0)});
  const Plane other_face{Eigen::Vector3d::UnitX(), 2.2};  // seen from behind, 0.2 m thick
  WallExtent other(other_face, {2.2, 7.03, 0.31}, 0.1);
  other.add(piece(1.0, 4.0));
  EXPECT_NEAR(wall.sharedArea_m2(other), 2.5, 0.3);
  EXPECT_NEAR(other.sharedArea_m2(wall), 2.5, 0.3);
  WallExtent apart(kWall, {2.0, 7.03, 0.31}, 0.1);
  apart.add(piece(3.0, 4.0));
  EXPECT_NEAR(wall.gap_m(apart).value(), 1.0, 0.11);
  EXPECT_NEAR(apart.gap_m(wall).value(), 1.0, 0.11);
}

TEST(WallExtent, PiecesLieFartherApartThanAGap) {
  const WallExtent wall = wallOf({piece(0.0, 2.0), piece(3.0, 4.0), piece(6.0, 10.0)});
  EXPECT_EQ(wall.pieces(0.5).size(), 3U);
  const std::vector<WallExtent> two = wall.pieces(1.5);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(two.front().area_m2(), 10.0, 1e-9);
}

TEST(WallExtent, OutlineLiesOnThePlaneAndTurnsLeftSeenFromTheFront) {
  const PlanarExtent outline = wallOf({piece(0.0, 2.0), piece(2.9, 4.0)}).outline_map(1.5);
  EXPECT_EQ(outline.outline.size(), 4U);
  EXPECT_EQ(outline.holes.size(), 1U);
  const Plane turned{Eigen::Vector3d(-1.0, 0.01, 0.0).normalized(), -2.05};
  const PlanarExtent lying = dropped(outline, turned);
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d& corner = lying.outline[k];
    EXPECT_NEAR(turned.normal.dot(corner), turned.distance, 1e-12);
    EXPECT_LT((corner - outline.outline[k]).norm(), 0.1);
    twice_area += corner.cross(lying.outline[(k + 1) % 4]);
  }
  EXPECT_NEAR(twice_area.dot(turned.normal), 20.0, 0.1);
}

/// At 500 m from the map's origin a small turn of a plane moves it far, but not along itself where
/// its anchor is.
TEST(WallExtent, IsTheSameFarFromTheOrigin) {
  const Eigen::Vector3d far(500.0, -300.0, 0.0);
  PlanarExtent extent = piece(0.0, 2.0);
  for (Eigen::Vector3d& corner : extent.outline) corner += far;
  const Plane plane{kWall.normal, kWall.distance + kWall.normal.dot(far)};
  WallExtent wall(plane, Eigen::Vector3d(2.0, 0.0, 0.0) + far, 0.1);
  wall.add(extent);
  EXPECT_NEAR(wall.area_m2(), 5.0, 1e-9);
  const Eigen::Vector3d turned = (plane.normal + Eigen::Vector3d(0.0, 0.002, 0.0)).normalized();
  const Plane other{turned, turned.dot(Eigen::Vector3d(2.0, 0.0, 0.0) + far)};
  WallExtent again(other, Eigen::Vector3d(2.0, 0.0, 0.0) + far, 0.1);
  again.add(extent);
  EXPECT_NEAR(wall.sharedArea_m2(again), 5.0, 0.3);
}

}  // namespace
}  // namespace mrpt_sgraphs
