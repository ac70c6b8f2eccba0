// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_set.h"

namespace mrpt_sgraphs {

/// A value for every cell of a box.
template <typename T>
class CellGrid {
 public:
  CellGrid() = default;
  explicit CellGrid(const CellBox& box, T value = {})
      : box_(box),
        values_(static_cast<std::size_t>(box.columns()) * static_cast<std::size_t>(box.rows()),
                value) {}

  const CellBox& box() const { return box_; }
  bool contains(Cell cell) const { return box_.contains(cell); }

  /// Of a cell of the box.
  T& operator[](Cell cell) { return values_[place(cell)]; }
  const T& operator[](Cell cell) const { return values_[place(cell)]; }

  /// Of any cell.
  T valueOr(Cell cell, T otherwise) const { return contains(cell) ? (*this)[cell] : otherwise; }

  /// Makes room for the cells of another box, with room to spare.
  void cover(const CellBox& other) {
    if (box_.united(other).columns() == box_.columns() &&
        box_.united(other).rows() == box_.rows()) {
      return;
    }
    constexpr int kSpare = 64;
    CellGrid larger(box_.united(other).grown(kSpare));
    forEach([&larger, this](Cell cell) { larger[cell] = std::move((*this)[cell]); });
    *this = std::move(larger);
  }

  /// The cells of the box, row by row.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (Cell cell = box_.min; cell.row <= box_.max.row; ++cell.row) {
      for (cell.column = box_.min.column; cell.column <= box_.max.column; ++cell.column) {
        visit(cell);
      }
    }
  }

 private:
  std::size_t place(Cell cell) const {
    return static_cast<std::size_t>(cell.row - box_.min.row) *
               static_cast<std::size_t>(box_.columns()) +
           static_cast<std::size_t>(cell.column - box_.min.column);
  }

  CellBox box_;
  std::vector<T> values_;
};

/// The cells that share an edge with one.
inline std::array<Cell, 4> neighboursOf(Cell cell) {
  return {Cell{cell.column + 1, cell.row}, Cell{cell.column, cell.row + 1},
          Cell{cell.column - 1, cell.row}, Cell{cell.column, cell.row - 1}};
}

}  // namespace mrpt_sgraphs
