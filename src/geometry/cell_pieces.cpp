// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// Which cells of a set belong together, by their edges or over a gap.

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "mrpt_sgraphs/geometry/cell_set.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::array<Cell, 4> kEdgeNeighbours{Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}};

Cell operator+(Cell a, Cell b) { return {a.column + b.column, a.row + b.row}; }

/// Moves all cells that hang together with `seed` from `open` to the result.
CellSet taken(Cell seed, CellSet* open) {
  CellSet part(open->box());
  std::vector<Cell> stack{seed};
  open->remove(seed);
  while (!stack.empty()) {
    const Cell cell = stack.back();
    stack.pop_back();
    part.add(cell);
    for (const Cell step : kEdgeNeighbours) {
      if (!open->contains(cell + step)) continue;
      open->remove(cell + step);
      stack.push_back(cell + step);
    }
  }
  return part;
}

/// For every cell of a box the nearest cell of a set, by two sweeps over the box (Danielsson,
/// "Euclidean Distance Mapping", 1980): wrong by less than a tenth of a cell, where at all.
class NearestCells {
 public:
  NearestCells(const CellSet& cells)
      : box_(cells.box()),
        nearest_(static_cast<std::size_t>(box_.columns()) * static_cast<std::size_t>(box_.rows()),
                 kNone) {
    cells.forEach([this](Cell cell) { at(cell) = cell; });
    for (int row = box_.min.row; row <= box_.max.row; ++row) sweepRow(row, -1);
    for (int row = box_.max.row; row >= box_.min.row; --row) sweepRow(row, 1);
  }

  Cell operator()(Cell cell) const { return nearest_[place(cell)]; }

 private:
  static constexpr Cell kNone{std::numeric_limits<int>::max(), 0};

  std::size_t place(Cell cell) const {
    return static_cast<std::size_t>(cell.row - box_.min.row) *
               static_cast<std::size_t>(box_.columns()) +
           static_cast<std::size_t>(cell.column - box_.min.column);
  }
  Cell& at(Cell cell) { return nearest_[place(cell)]; }

  void improve(Cell cell, Cell neighbour) {
    if (!box_.contains(neighbour)) return;
    const Cell candidate = at(neighbour);
    if (candidate == kNone) return;
    const auto squared = [cell](Cell other) {
      const double columns = other.column - cell.column;
      const double rows = other.row - cell.row;
      return columns * columns + rows * rows;
    };
    Cell& best = at(cell);
    if (best == kNone || squared(candidate) < squared(best)) best = candidate;
  }

  void sweepRow(int row, int from_row) {
    for (int column = box_.min.column; column <= box_.max.column; ++column) {
      for (int side = -1; side <= 1; ++side) {
        improve({column, row}, {column + side, row + from_row});
      }
      improve({column, row}, {column - 1, row});
    }
    for (int column = box_.max.column; column >= box_.min.column; --column) {
      improve({column, row}, {column + 1, row});
    }
  }

  CellBox box_;
  std::vector<Cell> nearest_;
};

/// Two cells of different parts with nothing nearer between them.
struct Bridge {
  double gap;  ///< In cells, between their nearest edges.
  Cell from;
  Cell to;
  std::size_t from_part;
  std::size_t to_part;
};

double gapBetween(Cell a, Cell b) {
  return std::hypot(std::max(0, std::abs(a.column - b.column) - 1),
                    std::max(0, std::abs(a.row - b.row) - 1));
}

/// Which part is nearest changes between two neighbouring cells: their nearest cells make a bridge.
/// The shortest between any two parts that no third comes between are among them.
std::vector<Bridge> bridgesBetween(const CellSet& cells, const std::vector<CellSet>& parts) {
  const NearestCells nearest(cells);
  const CellBox& box = cells.box();
  std::vector<std::size_t> part_of(
      static_cast<std::size_t>(box.columns()) * static_cast<std::size_t>(box.rows()), 0);
  const auto place = [&box](Cell cell) {
    return static_cast<std::size_t>(cell.row - box.min.row) *
               static_cast<std::size_t>(box.columns()) +
           static_cast<std::size_t>(cell.column - box.min.column);
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k].forEach([&](Cell cell) { part_of[place(cell)] = k; });
  }
  std::vector<Bridge> bridges;
  for (Cell cell = box.min; cell.row <= box.max.row; ++cell.row) {
    for (cell.column = box.min.column; cell.column <= box.max.column; ++cell.column) {
      const Cell from = nearest(cell);
      for (const Cell step : {Cell{1, 0}, Cell{-1, 1}, Cell{0, 1}, Cell{1, 1}}) {
        if (!box.contains(cell + step)) continue;
        const Cell to = nearest(cell + step);
        const std::size_t a = part_of[place(from)];
        const std::size_t b = part_of[place(to)];
        if (a != b) bridges.push_back({gapBetween(from, to), from, to, a, b});
      }
    }
  }
  std::stable_sort(bridges.begin(), bridges.end(),
                   [](const Bridge& a, const Bridge& b) { return a.gap < b.gap; });
  return bridges;
}

/// Parts that were joined are found under one number (union-find).
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t part) {
    while (parent_[part] != part) part = parent_[part] = parent_[parent_[part]];
    return part;
  }
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Cells from one to another, each with an edge in common with the next.
void addChain(Cell from, Cell to, CellSet* cells) {
  const int columns = std::abs(to.column - from.column);
  const int rows = std::abs(to.row - from.row);
  int column = 0;
  int row = 0;
  cells->add(from);
  while (column < columns || row < rows) {
    if (row == rows || (column < columns && (2 * column + 1) * rows <= (2 * row + 1) * columns)) {
      ++column;
    } else {
      ++row;
    }
    cells->add(Cell{from.column + (to.column > from.column ? column : -column),
                    from.row + (to.row > from.row ? row : -row)});
  }
}

}  // namespace

std::vector<CellSet> connectedParts(const CellSet& cells) {
  CellSet open = cells;
  std::vector<CellSet> parts;
  cells.forEach([&](Cell cell) {
    if (open.contains(cell)) parts.push_back(taken(cell, &open));
  });
  return parts;
}

std::vector<CellSet> pieces(const CellSet& cells, double max_gap) {
  const std::vector<CellSet> parts = connectedParts(cells);
  if (parts.size() < 2) return parts;
  Joined joined(parts.size());
  for (const Bridge& bridge : bridgesBetween(cells, parts)) {
    if (bridge.gap > max_gap) break;
    joined.join(bridge.from_part, bridge.to_part);
  }
  std::vector<CellSet> result(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) result[joined.find(k)].add(parts[k]);
  const auto is_empty = [](const CellSet& piece) { return piece.empty(); };
  result.erase(std::remove_if(result.begin(), result.end(), is_empty), result.end());
  std::stable_sort(result.begin(), result.end(),
                   [](const CellSet& a, const CellSet& b) { return a.size() > b.size(); });
  return result;
}

CellSet bridged(const CellSet& cells) {
  const std::vector<CellSet> parts = connectedParts(cells);
  CellSet result = cells;
  if (parts.size() < 2) return result;
  Joined joined(parts.size());
  for (const Bridge& bridge : bridgesBetween(cells, parts)) {
    if (joined.join(bridge.from_part, bridge.to_part)) addChain(bridge.from, bridge.to, &result);
  }
  return result;
}

CellSet withHolesFilled(const CellSet& cells) {
  const CellBox frame = cells.box().grown(1);
  CellSet open(frame);
  for (Cell cell = frame.min; cell.row <= frame.max.row; ++cell.row) {
    for (cell.column = frame.min.column; cell.column <= frame.max.column; ++cell.column) {
      if (!cells.contains(cell)) open.add(cell);
    }
  }
  taken(frame.min, &open);
  CellSet filled = cells;
  filled.add(open);
  return filled;
}

}  // namespace mrpt_sgraphs
