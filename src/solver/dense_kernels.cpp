// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "dense_kernels.h"

#include <algorithm>
#include <cmath>

// The bodies below are compiled twice, for every x86-64 and for those with AVX2 and FMA, and chosen
// when the program runs. They see plain doubles only, so that no type of Eigen or PCL changes its
// alignment, as it would with -march.
#define MRPT_SGRAPHS_INLINE inline __attribute__((always_inline))
#if defined(__x86_64__) && defined(__GNUC__)
#define MRPT_SGRAPHS_WIDE __attribute__((target("avx2,fma")))
#endif

// Vectors are handed between functions that are all inlined: there is no ABI to change.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace mrpt_sgraphs {
namespace {

using Vector = double __attribute__((vector_size(kVectorSize * sizeof(double))));
using UnalignedVector =
    double __attribute__((vector_size(kVectorSize * sizeof(double)), aligned(sizeof(double)), may_alias));

/// So many pivots are eliminated at a time.
constexpr int kBlock = 48;
/// From so many rows on, the block is packed first: it no longer fits the nearest cache.
constexpr int kPackRows = 96;

MRPT_SGRAPHS_INLINE Vector load(const double* p) {
  return *reinterpret_cast<const UnalignedVector*>(p);
}
MRPT_SGRAPHS_INLINE void store(double* p, Vector v) {
  *reinterpret_cast<UnalignedVector*>(p) = v;
}
MRPT_SGRAPHS_INLINE Vector broadcast(double x) { return Vector{x, x, x, x}; }

/// C -= X Y' for 8 or 4 rows and 4 columns; x and y step from one column to the next.
template <int Vectors>
MRPT_SGRAPHS_INLINE void tile(const double* x, long x_step, const double* y, long y_step,
                              int depth, double* c, long c_ld) {
  Vector sum[Vectors][4];
  for (int v = 0; v < Vectors; ++v) {
    for (int j = 0; j < 4; ++j) sum[v][j] = load(c + j * c_ld + v * kVectorSize);
  }
  for (int k = 0; k < depth; ++k, x += x_step, y += y_step) {
    Vector xs[Vectors];
    for (int v = 0; v < Vectors; ++v) xs[v] = load(x + v * kVectorSize);
    for (int j = 0; j < 4; ++j) {
      const Vector yj = broadcast(y[j]);
      for (int v = 0; v < Vectors; ++v) sum[v][j] -= xs[v] * yj;
    }
  }
  for (int v = 0; v < Vectors; ++v) {
    for (int j = 0; j < 4; ++j) store(c + j * c_ld + v * kVectorSize, sum[v][j]);
  }
}

/// Lower triangle of C -= X X' as far as its `columns` go; X is rows x depth.
MRPT_SGRAPHS_INLINE void subtractProduct(const double* x, long x_ld, int rows, int depth, double* c,
                                         long c_ld, int columns) {
  for (int j = 0; j < columns; j += 4) {
    int i = j;
    for (; i + 2 * kVectorSize <= rows; i += 2 * kVectorSize) {
      tile<2>(x + i, x_ld, x + j, x_ld, depth, c + j * c_ld + i, c_ld);
    }
    for (; i < rows; i += kVectorSize) {
      tile<1>(x + i, x_ld, x + j, x_ld, depth, c + j * c_ld + i, c_ld);
    }
  }
}

/// The same, the rows of X packed in groups of eight, each group column after column.
MRPT_SGRAPHS_INLINE void subtractPackedProduct(const double* x, int rows, int depth, double* c,
                                               long c_ld, int columns) {
  constexpr int kGroup = 2 * kVectorSize;
  for (int j = 0; j < columns; j += 4) {
    const double* y = x + static_cast<long>(j / kGroup) * kGroup * depth + j % kGroup;
    for (int i = j / kGroup * kGroup; i < rows; i += kGroup) {
      const double* group = x + static_cast<long>(i) * depth;
      double* target = c + j * c_ld + i;
      if (i >= j && i + kGroup <= padded(rows)) {
        tile<2>(group, kGroup, y, kGroup, depth, target, c_ld);
      } else if (i >= j) {
        tile<1>(group, kGroup, y, kGroup, depth, target, c_ld);
      } else {
        tile<1>(group + kVectorSize, kGroup, y, kGroup, depth, target + kVectorSize, c_ld);
      }
    }
  }
}

MRPT_SGRAPHS_INLINE void pack(const double* x, long x_ld, int rows, int depth, double* packed) {
  constexpr int kGroup = 2 * kVectorSize;
  for (int first = 0; first < rows; first += kGroup) {
    const int count = std::min(kGroup, rows - first);
    for (int k = 0; k < depth; ++k, packed += kGroup) {
      const double* source = x + k * x_ld + first;
      for (int i = 0; i < count; ++i) packed[i] = source[i];
      for (int i = count; i < kGroup; ++i) packed[i] = 0.0;
    }
  }
}

/// C -= X X', by way of a packed copy where X does not fit the nearest cache.
MRPT_SGRAPHS_INLINE void subtractSquare(const double* x, long x_ld, int rows, int depth, double* c,
                                        long c_ld, int columns, EliminationScratch* scratch) {
  if (rows < kPackRows) {
    subtractProduct(x, x_ld, rows, depth, c, c_ld, columns);
    return;
  }
  const auto size = static_cast<std::size_t>((rows + 7) / 8 * 8) * static_cast<std::size_t>(depth);
  if (scratch->packed.size() < size) scratch->packed.resize(size);
  pack(x, x_ld, rows, depth, scratch->packed.data());
  subtractPackedProduct(scratch->packed.data(), rows, depth, c, c_ld, columns);
}

/// The triangle of the block's own rows. `inverse` gets one over its diagonal.
MRPT_SGRAPHS_INLINE void eliminateTriangle(double* panel, long ld, int begin, int end,
                                           const double* min_pivots, double* inverse,
                                           std::vector<LostPivot>* lost) {
  for (int k = begin; k < end; ++k) {
    double* column = panel + k * ld;
    const double left = column[k];
    if (left > min_pivots[k]) {
      const double root = std::sqrt(left);
      inverse[k - begin] = 1.0 / root;
      column[k] = root;
    } else {  // also if it is not a number
      lost->push_back({k, left});
      inverse[k - begin] = 0.0;
      column[k] = 1.0;
    }
    for (int i = k + 1; i < end; ++i) column[i] *= inverse[k - begin];
    for (int j = k + 1; j < end; ++j) {
      double* other = panel + j * ld;
      const double a = column[j];
      for (int i = j; i < end; ++i) other[i] -= a * column[i];
    }
  }
}

/// The rows below a block of few pivots: a vector of rows stays in registers for all its columns.
template <int Pivots>
MRPT_SGRAPHS_INLINE void eliminateRowsBelow(double* panel, long ld, int rows,
                                            const double* inverse) {
  for (int i = Pivots; i < rows; i += kVectorSize) {
    Vector x[Pivots];
    for (int k = 0; k < Pivots; ++k) x[k] = load(panel + k * ld + i);
    for (int k = 0; k < Pivots; ++k) {
      x[k] *= broadcast(inverse[k]);
      store(panel + k * ld + i, x[k]);
      for (int j = k + 1; j < Pivots; ++j) x[j] -= broadcast(panel[k * ld + j]) * x[k];
    }
  }
}

/// The rows below any block, in strips that stay in the nearest cache.
MRPT_SGRAPHS_INLINE void eliminateRowsBelow(double* panel, long ld, int begin, int end, int rows,
                                            const double* inverse) {
  constexpr int kStrip = 64;
  for (int strip = end; strip < rows; strip += kStrip) {
    const int size = std::min(kStrip, rows - strip);
    for (int k = begin; k < end; ++k) {
      double* x = panel + k * ld;
      const Vector scale = broadcast(inverse[k - begin]);
      for (int i = strip; i < strip + size; i += kVectorSize) store(x + i, load(x + i) * scale);
      for (int j = k + 1; j < end; ++j) {
        double* y = panel + j * ld;
        const Vector a = broadcast(x[j]);
        for (int i = strip; i < strip + size; i += kVectorSize) {
          store(y + i, load(y + i) - a * load(x + i));
        }
      }
    }
  }
}

MRPT_SGRAPHS_INLINE void eliminateBody(const FrontView& front, const double* min_pivots,
                                       EliminationScratch* scratch, std::vector<LostPivot>* lost) {
  const int rows = front.pivots + front.rows + 1;
  const long ld = front.panelStride();
  double inverse[kBlock];
  for (int begin = 0; begin < front.pivots; begin += kBlock) {
    const int end = std::min(begin + kBlock, front.pivots);
    eliminateTriangle(front.panel, ld, begin, end, min_pivots, inverse, lost);
    if (front.pivots == 6) {
      eliminateRowsBelow<6>(front.panel, ld, rows, inverse);
    } else if (front.pivots == 3) {
      eliminateRowsBelow<3>(front.panel, ld, rows, inverse);
    } else {
      eliminateRowsBelow(front.panel, ld, begin, end, rows, inverse);
    }
    const double* block = front.panel + begin * ld;
    if (end < front.pivots) {  // the panel's columns that are still to come
      subtractSquare(block + end, ld, rows - end, end - begin, front.panel + end * ld + end, ld,
                     front.pivots - end, scratch);
    }
    if (front.rows > 0) {
      subtractSquare(block + front.pivots, ld, front.rows + 1, end - begin, front.update,
                     front.updateStride(), front.rows, scratch);
    }
  }
}

/// Pairs of x and y multiplied and added up.
MRPT_SGRAPHS_INLINE double dot(const double* x, const double* y, int size) {
  Vector sum[2] = {broadcast(0.0), broadcast(0.0)};
  int i = 0;
  for (; i + 2 * kVectorSize <= size; i += 2 * kVectorSize) {
    sum[0] += load(x + i) * load(y + i);
    sum[1] += load(x + i + kVectorSize) * load(y + i + kVectorSize);
  }
  if (i + kVectorSize <= size) {
    sum[0] += load(x + i) * load(y + i);
    i += kVectorSize;
  }
  const Vector all = sum[0] + sum[1];
  double rest = 0.0;
  for (; i < size; ++i) rest += x[i] * y[i];
  return ((all[0] + all[1]) + (all[2] + all[3])) + rest;
}

MRPT_SGRAPHS_INLINE void substituteBody(const double* panel, int pivots, int rows,
                                        const double* right, const double* later, double* own) {
  const long ld = FrontView::panelStride(pivots, rows);
  for (int k = pivots - 1; k >= 0; --k) {
    const double* column = panel + k * ld;
    own[k] = (right[k] - dot(column + pivots, later, rows) -
              dot(column + k + 1, own + k + 1, pivots - k - 1)) / column[k];
  }
}

void eliminatePortable(const FrontView& front, const double* min_pivots,
                       EliminationScratch* scratch, std::vector<LostPivot>* lost) {
  eliminateBody(front, min_pivots, scratch, lost);
}

void substitutePortable(const double* panel, int pivots, int rows, const double* right,
                        const double* later, double* own) {
  substituteBody(panel, pivots, rows, right, later, own);
}

#ifdef MRPT_SGRAPHS_WIDE
MRPT_SGRAPHS_WIDE void substituteWide(const double* panel, int pivots, int rows,
                                      const double* right, const double* later, double* own) {
  substituteBody(panel, pivots, rows, right, later, own);
}

MRPT_SGRAPHS_WIDE void eliminateWide(const FrontView& front, const double* min_pivots,
                                     EliminationScratch* scratch, std::vector<LostPivot>* lost) {
  eliminateBody(front, min_pivots, scratch, lost);
}
#endif

}  // namespace

std::size_t FrontView::panelSize(int pivots, int rows) {
  // tiles of four columns do not leave the panel
  const int columns = pivots > kBlock ? padded(pivots) : pivots;
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(panelStride(pivots, rows));
}

bool usesWideVectors() {
#ifdef MRPT_SGRAPHS_WIDE
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return wide;
#else
  return false;
#endif
}

void eliminatePivots(const FrontView& front, const double* min_pivots, EliminationScratch* scratch,
                     std::vector<LostPivot>* lost) {
#ifdef MRPT_SGRAPHS_WIDE
  if (usesWideVectors()) return eliminateWide(front, min_pivots, scratch, lost);
#endif
  eliminatePortable(front, min_pivots, scratch, lost);
}

void substituteBack(const double* panel, int pivots, int rows, const double* right,
                    const double* later, double* own) {
#ifdef MRPT_SGRAPHS_WIDE
  if (usesWideVectors()) return substituteWide(panel, pivots, rows, right, later, own);
#endif
  substitutePortable(panel, pivots, rows, right, later, own);
}

}  // namespace mrpt_sgraphs
