// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

/// A square of a grid in a plane: from (column, row) to (column + 1, row + 1) edges along u and v.
struct Cell {
  int column = 0;
  int row = 0;

  friend bool operator==(Cell a, Cell b) { return a.column == b.column && a.row == b.row; }
};

/// The cell that a point is in.
Cell cellAt(const Eigen::Vector2d& point, double cell_m);

/// All cells from `min` to `max`, both included; none while max is below min.
struct CellBox {
  Cell min;
  Cell max{-1, -1};

  int columns() const { return std::max(0, max.column - min.column + 1); }
  int rows() const { return std::max(0, max.row - min.row + 1); }
  bool empty() const { return columns() == 0 || rows() == 0; }
  bool contains(Cell cell) const {
    return cell.column >= min.column && cell.column <= max.column && cell.row >= min.row &&
           cell.row <= max.row;
  }
  CellBox grown(int cells) const;
  CellBox united(const CellBox& other) const {
    if (empty()) return other;
    if (other.empty()) return *this;
    return {{std::min(min.column, other.min.column), std::min(min.row, other.min.row)},
            {std::max(max.column, other.max.column), std::max(max.row, other.max.row)}};
  }
  CellBox shared(const CellBox& other) const;
};

/// A set of cells, in memory that grows with the box around them.
class CellSet {
 public:
  CellSet() = default;

  /// An empty set with room for the cells of a box.
  /// @throws std::length_error for a box of more than 2^28 cells.
  explicit CellSet(const CellBox& box);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool contains(Cell cell) const { return room_.contains(cell) && cells_[place(cell)] != 0; }

  /// Around all cells that were added.
  const CellBox& box() const { return box_; }

  /// @throws std::length_error as the constructor.
  void add(Cell cell) {
    if (!room_.contains(cell)) makeRoomFor(cell);
    uint8_t& entry = cells_[place(cell)];
    if (entry != 0) return;
    entry = 1;
    ++size_;
    box_ = box_.united({cell, cell});
  }
  void add(const CellSet& other);
  void remove(Cell cell) {
    if (!contains(cell)) return;
    cells_[place(cell)] = 0;
    --size_;
  }

  /// Adds the cells between any two in a row, then in a column, that are at most `max_gap` apart.
  void closeGaps(int max_gap);

  /// Row by row.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (Cell cell{0, box_.min.row}; cell.row <= box_.max.row; ++cell.row) {
      for (cell.column = box_.min.column; cell.column <= box_.max.column; ++cell.column) {
        if (contains(cell)) visit(cell);
      }
    }
  }

  template <typename Archive>
  void archive(Archive& a) {
    a("room", room_);
    a("box", box_);
    a("cells", cells_);
    a("size", size_);
  }

 private:
  std::size_t place(Cell cell) const {
    return static_cast<std::size_t>(cell.row - room_.min.row) *
               static_cast<std::size_t>(room_.columns()) +
           static_cast<std::size_t>(cell.column - room_.min.column);
  }

  void makeRoomFor(Cell cell);

  CellBox room_;  ///< What there is memory for.
  CellBox box_;
  std::vector<uint8_t> cells_;
  std::size_t size_ = 0;
};

/// The cells whose centres are inside of the outline and in none of the holes.
CellSet rasterized(const FlatExtent& extent, double cell_m);

/// Cells that are in both.
std::size_t sharedSize(const CellSet& a, const CellSet& b);

/// The least number of empty cells between the two along a row that both have: 0 where they touch
/// or overlap, none where they share no row.
std::optional<int> gapAlongRows(const CellSet& a, const CellSet& b);

/// The set, and the cells between two of its own in a row or column that are at most `max_gap`
/// cells apart.
CellSet withGapsClosed(const CellSet& cells, int max_gap);

/// Parts that are more than `max_gap` cells apart from each other (straight distance between their
/// nearest edges), the largest first.
std::vector<CellSet> pieces(const CellSet& cells, double max_gap);

/// The set as one piece by edges: chains of cells are added between the nearest cells of its parts.
CellSet bridged(const CellSet& cells);

/// The set, and what it encloses.
CellSet withHolesFilled(const CellSet& cells);

/// Parts that hang together by their edges, in the order of their first cells.
std::vector<CellSet> connectedParts(const CellSet& cells);

}  // namespace mrpt_sgraphs
