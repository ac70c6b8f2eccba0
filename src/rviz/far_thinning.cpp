// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "far_thinning.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace mrpt_sgraphs {
namespace {

/// A cell and how often the edge of the finest was doubled for it.
struct Cell {
  int level;
  Eigen::Matrix<std::int64_t, 3, 1> index;

  friend bool operator==(const Cell& a, const Cell& b) {
    return a.level == b.level && a.index == b.index;
  }
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    auto hash = static_cast<std::uint64_t>(cell.level);
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ static_cast<std::uint64_t>(cell.index[axis])) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29U;
    }
    return static_cast<std::size_t>(hash);
  }
};

Cell cellOf(const Eigen::Vector3d& place, double distance_m, double near_m) {
  const int level = static_cast<int>(std::floor(std::log2(distance_m / near_m)));
  const double edge_m = std::ldexp(kCellOverDistance * near_m, level);
  return {level, (place / edge_m).array().floor().matrix().cast<std::int64_t>()};
}

}  // namespace

std::vector<std::size_t> thinnedFarAway(const std::vector<Eigen::Vector3d>& places, const Eye& eye,
                                        double near_m) {
  std::unordered_map<Cell, std::size_t, CellHash> first_in;
  std::vector<std::size_t> shown(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double distance_m = eye.distanceTo(places[k]);
    const bool is_far = near_m > 0.0 && distance_m > near_m;
    shown[k] =
        is_far ? first_in.emplace(cellOf(places[k], distance_m, near_m), k).first->second : k;
  }
  return shown;
}

}  // namespace mrpt_sgraphs
