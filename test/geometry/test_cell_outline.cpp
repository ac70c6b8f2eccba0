// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {
namespace {

FlatExtent rectangle(double u0, double v0, double u1, double v1) {
  return {{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}, {}};
}

bool cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
           const Eigen::Vector2d& d) {
  const auto side = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                       const Eigen::Vector2d& r) {
    return (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
  };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

void expectSimple(const Outline2& ring) {
  ASSERT_GE(ring.size(), 3U);
  EXPECT_GT(signedArea(ring), 0.0) << "counter-clockwise";
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t k = i + 1; k < ring.size(); ++k) {
      EXPECT_FALSE(
          cross(ring[i], ring[(i + 1) % ring.size()], ring[k], ring[(k + 1) % ring.size()]));
    }
  }
}

TEST(CellOutline, OfNothingIsNothing) { EXPECT_TRUE(outlineOf(CellSet(), {}).outline.empty()); }

TEST(CellOutline, OfARectangleIsItsCorners) {
  const FlatExtent extent = outlineOf(rasterized(rectangle(-1.0, 0.5, 3.0, 2.5), 0.1), {});
  EXPECT_EQ(extent.outline.size(), 4U);
  EXPECT_TRUE(extent.holes.empty());
  EXPECT_NEAR(areaOf(extent), 8.0, 1e-9);
  expectSimple(extent.outline);
}

TEST(CellOutline, StraightensSlantedEdges) {
  for (const double angle_rad : {0.1, 0.5, 0.785, 1.3}) {
    SCOPED_TRACE(angle_rad);
    FlatExtent turned = rectangle(0.0, 0.0, 6.0, 2.0);
    const Eigen::Rotation2Dd rotation(angle_rad);
    for (Eigen::Vector2d& corner : turned.outline) corner = rotation * corner;
    const FlatExtent extent = outlineOf(rasterized(turned, 0.1), {});
    EXPECT_LE(extent.outline.size(), 8U);
    EXPECT_NEAR(areaOf(extent), 12.0, 0.6);
    expectSimple(extent.outline);
  }
}

TEST(CellOutline, ADoorIsAHoleAlsoWhereItReachesTheGround) {
  CellSet wall = rasterized(rectangle(0.0, 0.0, 5.0, 2.6), 0.1);
  for (int column = 20; column < 29; ++column) {
    for (int row = 0; row < 20; ++row) wall.remove({column, row});
  }
  const FlatExtent extent = outlineOf(wall, {});
  EXPECT_EQ(extent.outline.size(), 4U) << "the outline runs across the door";
  ASSERT_EQ(extent.holes.size(), 1U);
  EXPECT_NEAR(signedArea(extent.holes[0]), 1.8, 1e-9);
  EXPECT_EQ(rasterized(extent, 0.1).size(), wall.size());
}

TEST(CellOutline, AWideOpeningStaysOpen) {
  CellSet wall = rasterized(rectangle(0.0, 0.0, 8.0, 2.6), 0.1);
  for (int column = 20; column < 50; ++column) {
    for (int row = 0; row < 20; ++row) wall.remove({column, row});
  }
  const FlatExtent extent = outlineOf(wall, {});
  EXPECT_EQ(extent.outline.size(), 8U);
  EXPECT_TRUE(extent.holes.empty());
  expectSimple(extent.outline);
}

TEST(CellOutline, HolesLargeAndSmall) {
  CellSet wall = rasterized(rectangle(0.0, 0.0, 8.0, 5.0), 0.1);
  for (int column = 20; column < 50; ++column) {
    for (int row = 10; row < 40; ++row) wall.remove({column, row});
  }
  wall.remove({5, 5});
  wall.remove({60, 30});
  const FlatExtent extent = outlineOf(wall, {});
  EXPECT_EQ(extent.outline.size(), 4U);
  ASSERT_EQ(extent.holes.size(), 1U);
  EXPECT_NEAR(areaOf(extent), 40.0 - 9.0, 1e-9);
}

TEST(CellOutline, PiecesOverAGapHaveOneOutline) {
  CellSet wall = rasterized(rectangle(0.0, 0.0, 2.0, 2.0), 0.1);
  wall.add(rasterized(rectangle(3.0, 0.0, 5.0, 2.0), 0.1));
  const FlatExtent extent = outlineOf(wall, {});
  EXPECT_EQ(extent.outline.size(), 4U);
  EXPECT_EQ(extent.holes.size(), 1U);
  EXPECT_NEAR(areaOf(extent), 8.0, 1e-9);
}

/// Whatever the cells are, the polygon is one that others can work with.
TEST(CellOutline, IsSimpleForAnyCells) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    std::bernoulli_distribution filled(0.1 + 0.014 * trial);
    CellSet cells;
    for (int column = -20; column < 25; ++column) {
      for (int row = -10; row < 15; ++row) {
        if (filled(generator)) cells.add(Cell{column, row});
      }
    }
    CellOutlineConfig config;
    config.max_gap_m = 0.1 * (trial % 4);
    config.min_hole_m2 = 0.03;
    const FlatExtent extent = outlineOf(cells, config);
    expectSimple(extent.outline);
    for (const Outline2& hole : extent.holes) expectSimple(hole);
  }
}

TEST(CellOutline, CoversTheCellsWithinACell) {
  std::mt19937 generator(9);
  std::uniform_int_distribution<int> place(0, 60);
  for (int trial = 0; trial < 20; ++trial) {
    CellSet cells;
    for (int k = 0; k < 12; ++k) {
      const double u = 0.1 * place(generator);
      const double v = 0.1 * place(generator);
      cells.add(rasterized(rectangle(u, v, u + 1.5, v + 1.0), 0.1));
    }
    const CellSet again = rasterized(outlineOf(cells, {0.1, 0.0, 0.0}), 0.1);
    const double shared = static_cast<double>(sharedSize(cells, again));
    EXPECT_GT(shared, 0.97 * static_cast<double>(cells.size()));
    EXPECT_GT(shared, 0.93 * static_cast<double>(again.size()));
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
