// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/placed_clouds.h"

namespace mrpt_sgraphs {

/// The points of all keyframes in `map`, averaged in voxels; it follows the graph. Sums are of whole
/// numbers, so that what was added can be taken out again and no trace is left.
class PointMap {
 public:
  explicit PointMap(double voxel_m);

  /// Takes in what is new, and again what has moved by more than a quarter of a voxel; takes out
  /// what is gone.
  /// @return Whether there was anything.
  bool update(const GraphSnapshot& graph);

  /// One point a voxel, in an order that depends on nothing but where they are.
  Cloud::Ptr cloud() const;

 private:
  struct Sum {
    std::int64_t points = 0;
    std::array<std::int64_t, 3> offset{};  ///< From the voxel's corner, in tenths of a millimetre.
    std::int64_t intensity = 0;            ///< In sixteenths.
  };

  void count(const Cloud& cloud_base, const Pose& T_map_base, int sign);

  double voxel_m_;
  PlacedClouds placed_;
  std::unordered_map<std::uint64_t, Sum> sums_;
};

}  // namespace mrpt_sgraphs
