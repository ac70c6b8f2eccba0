// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

namespace mrpt_sgraphs {

/// Columns are padded to whole vectors, so that the kernels have no remainders to treat.
constexpr int kVectorSize = 4;
constexpr int padded(int rows) { return (rows + kVectorSize - 1) / kVectorSize * kVectorSize; }

/// A front while its pivots are eliminated: the lower triangle of
///
///     [ A      ]  p pivots
///     [ B  C   ]  m rows              panel: the first p columns
///     [ a' c'  ]  right-hand side     update: the columns behind them, from C on
///
/// column-major. What lies above the diagonal or behind the last row is scratch, and has to be there.
struct FrontView {
  double* panel = nullptr;
  double* update = nullptr;
  int pivots = 0;  ///< p
  int rows = 0;    ///< m

  int panelStride() const { return panelStride(pivots, rows); }
  int updateStride() const { return padded(rows + 1); }

  /// Columns begin so far apart. More pivots than one block are eliminated block by block.
  static int panelStride(int pivots, int rows) {
    const int behind_pivots = pivots + padded(rows + 1);
    return behind_pivots > padded(pivots + rows + 1) ? behind_pivots : padded(pivots + rows + 1);
  }
  /// Of the panel or the update, whichever has the column; [row] is the front's row, from it on.
  double* column(int column) const {
    return column < pivots
               ? panel + static_cast<std::ptrdiff_t>(column) * panelStride()
               : update + static_cast<std::ptrdiff_t>(column - pivots) * updateStride() - pivots;
  }
  int strideAt(int column) const { return column < pivots ? panelStride() : updateStride(); }

  static std::size_t panelSize(int pivots, int rows);
  static std::size_t updateSize(int rows) {
    return static_cast<std::size_t>(padded(rows)) * static_cast<std::size_t>(padded(rows + 1));
  }
};

/// Where a pivot was found to be none.
struct LostPivot {
  int column = 0;
  double value = 0.0;  ///< What was left of it.
};

/// Scratch of eliminatePivots, kept to save its allocation.
struct EliminationScratch {
  std::vector<double> packed;
};

/// Partial Cholesky factorization: the panel becomes the columns of the factor, [L; B L^-T; y'], and
/// the update what is left, C - B A^-1 B'.
///
/// A pivot of which less than `min_pivots[column]` is left carries no information: its column becomes
/// that of the identity, so that the solution has a zero there, and it is noted in `lost`.
void eliminatePivots(const FrontView& front, const double* min_pivots, EliminationScratch* scratch,
                     std::vector<LostPivot>* lost);

/// The pivots' part of the solution of L' x = right, for a panel that eliminatePivots has made.
/// @param later  x of the front's rows.
/// @param own    Gets x of its pivots.
void substituteBack(const double* panel, int pivots, int rows, const double* right,
                    const double* later, double* own);

/// True if this machine's wider vectors are used.
bool usesWideVectors();

}  // namespace mrpt_sgraphs
