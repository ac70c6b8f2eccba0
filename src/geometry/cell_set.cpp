// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/cell_set.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

/// Where a ring crosses the centres of a row, added to `crossings`.
void crossingsOf(const Outline2& ring, double v, std::vector<double>* crossings) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d& a = ring[k];
    const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
    if ((a.y() <= v) == (b.y() <= v)) continue;
    crossings->push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

}  // namespace

Cell cellAt(const Eigen::Vector2d& point, double cell_m) {
  return {static_cast<int>(std::floor(point.x() / cell_m)),
          static_cast<int>(std::floor(point.y() / cell_m))};
}

CellBox CellBox::grown(int cells) const {
  return {{min.column - cells, min.row - cells}, {max.column + cells, max.row + cells}};
}

CellBox CellBox::shared(const CellBox& other) const {
  return {{std::max(min.column, other.min.column), std::max(min.row, other.min.row)},
          {std::min(max.column, other.max.column), std::min(max.row, other.max.row)}};
}

CellSet::CellSet(const CellBox& box) : room_(box) {
  constexpr double kMaxCells = 268435456.0;
  if (static_cast<double>(box.columns()) * static_cast<double>(box.rows()) > kMaxCells) {
    throw std::length_error("a set of cells is too large");
  }
  cells_.resize(static_cast<std::size_t>(box.columns()) * static_cast<std::size_t>(box.rows()));
}

void CellSet::makeRoomFor(Cell cell) {
  // Half as much again to each side: what grows cell by cell is not copied cell by cell.
  const CellBox needed = room_.united({cell, cell});
  CellSet larger(needed.grown(4 + std::max(needed.columns(), needed.rows()) / 4));
  larger.add(*this);
  *this = std::move(larger);
}

void CellSet::add(const CellSet& other) {
  other.forEach([this](Cell cell) { add(cell); });
}

void CellSet::closeGaps(int max_gap) {
  const auto fill = [this](std::size_t from, std::size_t to, std::size_t step) {
    for (std::size_t at = from + step; at < to; at += step) {
      cells_[at] = 1;
      ++size_;
    }
  };
  constexpr int kNone = std::numeric_limits<int>::min() / 2;
  const std::size_t row_step = static_cast<std::size_t>(room_.columns());
  for (int row = box_.min.row; row <= box_.max.row; ++row) {
    int last = kNone;
    for (int column = box_.min.column; column <= box_.max.column; ++column) {
      const std::size_t at = place({column, row});
      if (cells_[at] == 0) continue;
      if (column - last - 1 <= max_gap) fill(place({last, row}), at, 1);
      last = column;
    }
  }
  std::vector<int> last_row(static_cast<std::size_t>(box_.columns()), kNone);
  for (int row = box_.min.row; row <= box_.max.row; ++row) {
    for (int column = box_.min.column; column <= box_.max.column; ++column) {
      const std::size_t at = place({column, row});
      if (cells_[at] == 0) continue;
      int& last = last_row[static_cast<std::size_t>(column - box_.min.column)];
      if (row - last - 1 <= max_gap) fill(place({column, last}), at, row_step);
      last = row;
    }
  }
}

CellSet rasterized(const FlatExtent& extent, double cell_m) {
  if (extent.outline.empty()) return {};
  Eigen::Vector2d low = extent.outline.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& corner : extent.outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  CellSet cells(CellBox{cellAt(low, cell_m), cellAt(high, cell_m)});
  std::vector<double> crossings;
  for (int row = cellAt(low, cell_m).row; row <= cellAt(high, cell_m).row; ++row) {
    const double v = (row + 0.5) * cell_m;
    crossings.clear();
    crossingsOf(extent.outline, v, &crossings);
    for (const Outline2& hole : extent.holes) crossingsOf(hole, v, &crossings);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int first = static_cast<int>(std::ceil(crossings[k] / cell_m - 0.5));
      for (int column = first; (column + 0.5) * cell_m < crossings[k + 1]; ++column) {
        cells.add(Cell{column, row});
      }
    }
  }
  return cells;
}

std::size_t sharedSize(const CellSet& a, const CellSet& b) {
  const CellBox both = a.box().shared(b.box());
  std::size_t count = 0;
  for (Cell cell{0, both.min.row}; cell.row <= both.max.row; ++cell.row) {
    for (cell.column = both.min.column; cell.column <= both.max.column; ++cell.column) {
      if (a.contains(cell) && b.contains(cell)) ++count;
    }
  }
  return count;
}

std::optional<int> gapAlongRows(const CellSet& a, const CellSet& b) {
  const CellBox both = a.box().united(b.box());
  const int first = std::max(a.box().min.row, b.box().min.row);
  const int last = std::min(a.box().max.row, b.box().max.row);
  std::optional<int> gap;
  for (int row = first; row <= last; ++row) {
    std::optional<int> last_a;
    std::optional<int> last_b;
    for (int column = both.min.column; column <= both.max.column; ++column) {
      if (a.contains({column, row})) last_a = column;
      if (b.contains({column, row})) last_b = column;
      if (!last_a || !last_b) continue;
      const int between = std::max(0, std::abs(*last_a - *last_b) - 1);
      if (!gap || between < *gap) gap = between;
    }
    if (gap && *gap == 0) break;
  }
  return gap;
}

CellSet withGapsClosed(const CellSet& cells, int max_gap) {
  CellSet closed = cells;
  // A cell that was filled along a row may be the end of a gap in a column, and so on; what a few
  // rounds leave open are corners between pieces that lie askew.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t size = closed.size();
    closed.closeGaps(max_gap);
    if (closed.size() == size) break;
  }
  return closed;
}

}  // namespace mrpt_sgraphs
