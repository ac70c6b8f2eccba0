// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <stdexcept>

#include "mrpt_sgraphs/geometry/cell_set.h"

namespace mrpt_sgraphs {
namespace {

CellSet block(Cell min, Cell max) {
  CellSet cells;
  for (int row = min.row; row <= max.row; ++row) {
    for (int column = min.column; column <= max.column; ++column) cells.add(Cell{column, row});
  }
  return cells;
}

CellSet united(CellSet a, const CellSet& b) {
  a.add(b);
  return a;
}

TEST(CellSet, HoldsWhatWasAddedWhereverThatIs) {
  CellSet cells;
  EXPECT_TRUE(cells.empty());
  EXPECT_FALSE(cells.contains({0, 0}));
  cells.add(Cell{-7, 5000});
  cells.add(Cell{300, -20});
  cells.add(Cell{300, -20});
  EXPECT_EQ(cells.size(), 2U);
  EXPECT_TRUE(cells.contains({-7, 5000}));
  EXPECT_FALSE(cells.contains({-7, -20}));
  EXPECT_EQ(cells.box().min, (Cell{-7, -20}));
  EXPECT_EQ(cells.box().max, (Cell{300, 5000}));
  cells.remove({-7, 5000});
  cells.remove({0, 0});
  EXPECT_EQ(cells.size(), 1U);
}

TEST(CellSet, RefusesMoreThanTheMachineHolds) {
  CellSet cells;
  cells.add(Cell{0, 0});
  EXPECT_THROW(cells.add(Cell{100000000, 1000000}), std::length_error);
  EXPECT_EQ(cells.size(), 1U);
}

TEST(CellSet, RasterizesAnOutlineWithAHole) {
  FlatExtent extent;
  extent.outline = {{-1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {-1.0, 1.0}};
  extent.holes = {{{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.4}, {0.0, 0.4}}};
  const CellSet cells = rasterized(extent, 0.1);
  EXPECT_EQ(cells.size(), 300U - 20U);
  EXPECT_TRUE(cells.contains({-10, 0}));
  EXPECT_TRUE(cells.contains({19, 9}));
  EXPECT_FALSE(cells.contains({20, 9}));
  EXPECT_FALSE(cells.contains({0, 0}));
  EXPECT_TRUE(cells.contains({0, 4}));
}

TEST(CellSet, RasterizesNothingFromNothing) {
  EXPECT_TRUE(rasterized(FlatExtent{}, 0.1).empty());
  EXPECT_TRUE(rasterized(FlatExtent{{{1.0, 1.0}, {2.0, 2.0}}, {}}, 0.1).empty());
}

TEST(CellSet, GapAlongRowsIsTheOneAtACommonHeight) {
  const CellSet wall = block({0, 0}, {9, 9});
  EXPECT_EQ(gapAlongRows(wall, block({9, 5}, {12, 7})), 0);
  EXPECT_EQ(gapAlongRows(wall, block({10, 5}, {12, 7})), 0);
  EXPECT_EQ(gapAlongRows(wall, block({15, 9}, {20, 20})), 5);
  EXPECT_EQ(gapAlongRows(block({15, 9}, {20, 20}), wall), 5);
  EXPECT_FALSE(gapAlongRows(wall, block({0, 10}, {9, 12}))) << "above one another";
  EXPECT_FALSE(gapAlongRows(wall, CellSet()));
  EXPECT_EQ(sharedSize(wall, block({8, 8}, {20, 20})), 4U);
}

TEST(CellSet, PiecesAreApartByMoreThanTheGap) {
  CellSet cells = united(block({0, 0}, {9, 9}), block({20, 0}, {39, 9}));
  cells.add(block({44, 12}, {45, 13}));  // 4 columns and 2 rows away from the second
  EXPECT_EQ(pieces(cells, 3.0).size(), 3U);
  EXPECT_EQ(pieces(cells, 4.4).size(), 3U);
  EXPECT_EQ(pieces(cells, 4.5).size(), 2U);
  EXPECT_EQ(pieces(cells, 9.9).size(), 2U);
  EXPECT_EQ(pieces(cells, 10.0).size(), 1U);
  EXPECT_EQ(pieces(cells, 4.5).front().size(), 204U) << "the largest first";
  EXPECT_TRUE(pieces(CellSet(), 1.0).empty());
}

TEST(CellSet, BridgesJoinAllPiecesWithFewCells) {
  CellSet cells = united(block({0, 0}, {9, 9}), block({20, 12}, {39, 19}));
  cells.add(block({60, 0}, {61, 1}));
  const CellSet joined = bridged(cells);
  EXPECT_EQ(connectedParts(joined).size(), 1U);
  EXPECT_EQ(sharedSize(joined, cells), cells.size());
  EXPECT_LT(joined.size(), cells.size() + 50U);
}

TEST(CellSet, ClosesGapsUpToALength) {
  const CellSet cells = united(block({0, 0}, {4, 4}), block({10, 0}, {14, 4}));
  EXPECT_EQ(withGapsClosed(cells, 4).size(), 50U);
  EXPECT_EQ(withGapsClosed(cells, 5).size(), 75U);
}

TEST(CellSet, FillsOnlyWhatIsEnclosed) {
  CellSet ring = block({0, 0}, {9, 9});
  for (int column = 2; column < 8; ++column) {
    for (int row = 2; row < 8; ++row) ring.remove({column, row});
  }
  EXPECT_EQ(withHolesFilled(ring).size(), 100U);
  ring.remove({4, 0});
  ring.remove({4, 1});
  EXPECT_EQ(withHolesFilled(ring).size(), ring.size());
}

}  // namespace
}  // namespace mrpt_sgraphs
