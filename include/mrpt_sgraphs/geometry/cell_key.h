// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>

namespace mrpt_sgraphs {

/// A cell of a grid in space as one number: 21 bits a coordinate, a million cells to each side.
using CellKey = std::uint64_t;

constexpr int kCellKeyBits = 21;
constexpr std::int64_t kCellKeyOffset = std::int64_t{1} << (kCellKeyBits - 1);
constexpr CellKey kCellKeyMask = (CellKey{1} << kCellKeyBits) - 1;

inline CellKey cellKey(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto part = [](std::int64_t v) {
    return static_cast<CellKey>(v + kCellKeyOffset) & kCellKeyMask;
  };
  return part(x) << (2 * kCellKeyBits) | part(y) << kCellKeyBits | part(z);
}

/// Inverse of cellKey.
inline std::array<int, 3> cellIndexOf(CellKey key) {
  const auto part = [key](int shift) {
    return static_cast<int>(static_cast<std::int64_t>(key >> shift & kCellKeyMask) -
                            kCellKeyOffset);
  };
  return {part(2 * kCellKeyBits), part(kCellKeyBits), part(0)};
}

}  // namespace mrpt_sgraphs
