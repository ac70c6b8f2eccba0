// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/map_config.h"
#include "mrpt_sgraphs/mapping/placed_clouds.h"
#include "mrpt_sgraphs/mapping/ray_marks.h"

namespace mrpt_sgraphs {

/// What the rays of all keyframes have crossed and hit, in voxels of `map`; it follows the graph.
///
/// Evidence of a voxel is a sum of whole numbers, 3 for a cloud that hit it and -1 for one that only
/// crossed it. So taking a cloud out leaves what there would be without it, and a map whose
/// keyframes have moved is the one that is made of them anew. Evidence is cut off at 32000, ten
/// thousand clouds away.
class OccupancyMap {
 public:
  explicit OccupancyMap(const MapConfig& config);

  /// Takes in what is new, and again what has moved by more than a quarter of a cell; takes out what
  /// is gone: keyframes, or their clouds. A keyframe more than 30000 cells from the origin of the
  /// map is no part of it.
  /// @return Whether there was anything.
  bool update(const GraphSnapshot& graph);

  /// Above zero: occupied; below: free; zero: unknown.
  int evidenceAt(const Voxel& voxel) const;
  double cell_m() const { return config_.cell_m; }
  Eigen::Vector3d centreOf(const Voxel& voxel) const {
    return config_.cell_m * Eigen::Vector3d(voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5);
  }
  bool empty() const { return blocks_.empty(); }

  /// Voxels that are known, and bytes that they take.
  std::size_t size() const;
  std::size_t bytes() const { return blocks_.size() * sizeof(Block); }

  /// Calls `visit(voxel, is_occupied)` for every voxel that is known, in an order that depends on
  /// nothing but which these are.
  template <typename Visit>
  void forEachKnown(const Visit& visit) const {
    for (const auto& [corner, block] : inOrder()) {
      for (int k = 0; k < kVoxels; ++k) {
        const int evidence = block->evidence[static_cast<std::size_t>(k)];
        if (evidence == 0) continue;
        visit(Voxel{corner[0] + k % kEdge, corner[1] + k / kEdge % kEdge,
                    corner[2] + k / (kEdge * kEdge)},
              evidence > 0);
      }
    }
  }

 private:
  static constexpr int kEdge = 8;  ///< Voxels along the edge of a block.
  static constexpr int kVoxels = kEdge * kEdge * kEdge;

  struct Block {
    std::array<int16_t, kVoxels> evidence{};
    int known = 0;
  };

  void count(const Cloud& cloud_base, const Pose& T_map_base, int sign);
  /// Lowest corner and block, in the order of their places.
  std::vector<std::pair<Voxel, const Block*>> inOrder() const;

  MapConfig config_;
  PlacedClouds placed_;
  RayMarks marks_;
  std::unordered_map<std::uint64_t, Block> blocks_;
};

}  // namespace mrpt_sgraphs
