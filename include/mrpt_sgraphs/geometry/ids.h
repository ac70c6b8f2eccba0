// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

namespace mrpt_sgraphs {

/// An id of one layer. Ids of two layers do not mix, and no id is ever given twice.
template <typename Layer>
struct Id {
  uint64_t value = 0;

  friend bool operator==(Id a, Id b) { return a.value == b.value; }
  friend bool operator!=(Id a, Id b) { return a.value != b.value; }
  friend bool operator<(Id a, Id b) { return a.value < b.value; }
};

using KeyframeId = Id<struct KeyframeLayer>;
using WallId = Id<struct WallLayer>;
using RoomId = Id<struct RoomLayer>;
using FloorId = Id<struct FloorLayer>;

}  // namespace mrpt_sgraphs

template <typename Layer>
struct std::hash<mrpt_sgraphs::Id<Layer>> {
  std::size_t operator()(mrpt_sgraphs::Id<Layer> id) const noexcept {
    return std::hash<uint64_t>{}(id.value);
  }
};
