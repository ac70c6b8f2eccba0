// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/triangulation.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using Ring = Outline2;

Ring box(double u0, double v0, double u1, double v1) {
  return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

double areaOf(const Triangle2& t) { return signedArea({t[0], t[1], t[2]}); }

/// None is flat or clockwise, and a point is in one of them where it is in the extent, and in none
/// elsewhere.
double expectCoverage(const std::vector<Triangle2>& triangles, const FlatExtent& extent) {
  double sum = 0.0;
  for (const Triangle2& triangle : triangles) {
    EXPECT_GT(areaOf(triangle), 0.0);
    sum += areaOf(triangle);
  }
  test::RandomGeometry random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector2d point(5.0 + random.number(6.0), 2.0 + random.number(4.0));
    const auto over = std::count_if(triangles.begin(), triangles.end(), [&](const Triangle2& t) {
      return contains(FlatExtent{{t[0], t[1], t[2]}, {}}, point);
    });
    EXPECT_EQ(over, contains(extent, point) ? 1 : 0) << point.transpose();
  }
  return sum;
}

/// Of rings that do not cross, the areas add up too.
void expectTriangulated(const FlatExtent& extent) {
  const double sum = expectCoverage(triangulated(extent), extent);
  EXPECT_NEAR(sum, mrpt_sgraphs::areaOf(extent), 1e-6 * (1.0 + sum));
}

TEST(Triangulation, OfAConvexOutlineHasTwoTrianglesLessThanCorners) {
  const FlatExtent hexagon{{{0, 0}, {4, -1}, {8, 0}, {8, 3}, {4, 4}, {0, 3}}, {}};
  EXPECT_EQ(triangulated(hexagon).size(), 4U);
  expectTriangulated(hexagon);
}

TEST(Triangulation, OfAWallWithADoorTakesThreeRectangles) {
  EXPECT_EQ(triangulated(FlatExtent{box(0, 0, 5, 2.6), {box(2, 0, 2.9, 2)}}).size(), 6U);
}

TEST(Triangulation, OfLessThanATriangleIsNothing) {
  EXPECT_TRUE(triangulated(FlatExtent{}).empty());
  EXPECT_TRUE(triangulated(FlatExtent{{{0, 0}, {1, 0}}, {}}).empty());
  EXPECT_TRUE(triangulated(FlatExtent{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {}}).empty());
}

TEST(Triangulation, TakesRingsEitherWayRound) {
  FlatExtent extent{{{0, 0}, {9, 0}, {9, 2}, {4, 2}, {4, 5}, {0, 5}}, {box(1, 1, 2, 2)}};
  expectTriangulated(extent);
  std::reverse(extent.outline.begin(), extent.outline.end());
  expectTriangulated(extent);
  std::reverse(extent.holes[0].begin(), extent.holes[0].end());
  expectTriangulated(extent);
}

TEST(Triangulation, BearsCornersInLineAndCornersThatAreThereTwice) {
  expectTriangulated(
      {{{0, 0}, {2, 0}, {2, 0}, {5, 0}, {9, 0}, {9, 4}, {9, 4}, {4, 4}, {0, 4}, {0, 1}},
       {{{1, 1}, {2, 1}, {3, 1}, {3, 3}, {3, 3}, {1, 3}, {1, 2}}}});
}

TEST(Triangulation, GoesAroundManyHolesInRowsAndColumns) {
  FlatExtent facade{box(0, 0, 10, 5), {}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 6; ++column) {
      facade.holes.push_back(
          box(0.5 + 1.5 * column, 0.5 + 1.5 * row, 1.5 + 1.5 * column, 1.5 + 1.5 * row));
    }
  }
  expectTriangulated(facade);
}

TEST(Triangulation, BearsHolesThatTouchTheOutlineAndEachOther) {
  expectTriangulated({box(0, 0, 10, 3), {box(2, 0, 2.9, 2)}});                   // a door
  expectTriangulated({box(0, 0, 10, 3), {box(0, 0, 1, 2), box(9, 0, 10, 2)}});   // in the corners
  expectTriangulated({box(0, 0, 10, 3), {box(2, 0, 3, 2), box(3, 0, 4, 1)}});    // side by side
  expectTriangulated({box(0, 0, 10, 3), {box(2, 0.5, 3, 1), box(3, 1, 4, 2)}});  // by a corner
  expectTriangulated({box(0, 0, 10, 3), {box(2, 0, 3, 3)}});                     // cut in two
  expectTriangulated({box(0, 0, 10, 3), {{{2, 1}, {3, 0}, {4, 1}}, box(6, 0, 7, 2)}});
}

TEST(Triangulation, TakesAwayWhatHolesHaveInCommonWithTheOutline) {
  const FlatExtent crossing{box(0, 0, 10, 3), {box(2, -0.05, 3, 2), box(2.95, 1, 4, 2.5)}};
  EXPECT_NEAR(expectCoverage(triangulated(crossing), crossing), 30.0 - 2.0 - 1.5, 0.05 + 1e-6);
  const FlatExtent beside{box(0, 0, 4, 3), {box(6, 1, 7, 2)}};
  EXPECT_NEAR(expectCoverage(triangulated(beside), beside), 12.0, 1e-6);
}

TEST(Triangulation, OfRingsThatCrossThemselvesCoversWhatTheyContain) {
  test::RandomGeometry random(5);
  const auto ring = [&random](int corners) {
    Ring result;
    for (int k = 0; k < corners; ++k) {
      result.emplace_back(5.0 + random.number(6.0), 2.0 + random.number(4.0));
    }
    return result;
  };
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const FlatExtent extent{ring(20), {ring(3), ring(8)}};
    expectCoverage(triangulated(extent), extent);
  }
}

/// A wall as the segmentation makes it: boxes of cells, doors and windows cut out of them.
FlatExtent randomWall(unsigned seed) {
  std::mt19937 generator(seed);
  const auto pick = [&generator](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator);
  };
  CellSet cells(CellBox{{0, 0}, {100, 40}});
  const auto each = [](int column, int row, int columns, int rows, const auto& visit) {
    for (int c = column; c < std::min(column + columns, 100); ++c) {
      for (int r = row; r < std::min(row + rows, 40); ++r) visit(Cell{c, r});
    }
  };
  for (int k = 0; k < 8; ++k) {
    each(pick(0, 80), pick(0, 30), pick(5, 60), pick(5, 30), [&](Cell c) { cells.add(c); });
  }
  for (int k = 0; k < 6; ++k) {
    each(pick(0, 90), pick(0, 30), pick(3, 12), pick(3, 20), [&](Cell c) { cells.remove(c); });
  }
  return outlineOf(cells, {});
}

TEST(Triangulation, CoversWallsWithDoorsAndWindows) {
  std::size_t holes = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const FlatExtent wall = randomWall(seed);
    holes += wall.holes.size();
    const auto triangles = triangulated(wall);
    expectCoverage(triangles, wall);
    std::size_t corners = wall.outline.size();
    for (const Ring& hole : wall.holes) corners += hole.size();
    EXPECT_LE(triangles.size(), 2 * corners);
  }
  EXPECT_GT(holes, 200U);
}

TEST(Triangulation, OfAWallInSpaceLiesInItsPlaneAndFacesItsSide) {
  test::RandomGeometry random(9);
  const FlatExtent flat{box(0, 0, 5, 2.6), {box(2, 0, 2.9, 2), box(3.5, 1, 4, 1.5)}};
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    const Plane plane{random.vector(1.0).normalized(), 300.0};
    const PlaneFrame frame(plane, random.vector(500.0));
    double sum = 0.0;
    for (const Triangle3& t : triangulated(lifted(flat, frame), plane)) {
      const Eigen::Vector3d cross = (t[1] - t[0]).cross(t[2] - t[0]);
      EXPECT_GT(cross.dot(plane.normal), 0.0);
      for (const Eigen::Vector3d& corner : t) {
        EXPECT_NEAR(plane.normal.dot(corner), plane.distance, 1e-9);
      }
      sum += 0.5 * cross.norm();
    }
    EXPECT_NEAR(sum, mrpt_sgraphs::areaOf(flat), 1e-5);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
