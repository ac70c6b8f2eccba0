// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Column, row and layer of a voxel: it reaches from (column, row, layer) to one edge more of each.
using Voxel = std::array<int, 3>;

/// Which rays of a cloud are followed, and how far.
struct RayLimits {
  double cell_m = 0.1;
  double max_range_m = 15.0;  ///< From the sensor; a point farther away is not hit.
  int max_rays = 10000;       ///< Of more, every second, third, ... is taken.
};

/// Layers of voxels from a lowest one up.
struct LayerRange {
  int bottom = 0;
  int layers = 0;
};

/// What the rays of one cloud tell of each voxel: that they crossed it or, where one of them ends in
/// it, hit it. However many rays meet in a voxel, it is told once.
class RayMarks {
 public:
  /// @param slab  What lies above and below is passed over; none: nothing does.
  void cast(const Cloud& cloud_base, const Pose& T_frame_base, const RayLimits& limits,
            const std::optional<LayerRange>& slab);

  /// Around all voxels that the last cloud told of, in the frame.
  const CellBox& window() const { return window_; }

  /// Calls `visit(voxel, is_hit)` for each of them, layer by layer and row by row.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    const Mark* mark = marks_.data();
    for (int layer = 0; layer < slab_.layers; ++layer) {
      for (int row = window_.min.row; row <= window_.max.row; ++row) {
        for (int column = window_.min.column; column <= window_.max.column; ++column, ++mark) {
          if (*mark != Mark::kNone) {
            visit(Voxel{column, row, slab_.bottom + layer}, *mark == Mark::kHit);
          }
        }
      }
    }
  }

 private:
  enum class Mark : uint8_t { kNone, kCrossed, kHit };

  /// The part of a ray that is followed, in voxels of the frame.
  struct Ray {
    Eigen::Vector3f end;
    bool is_hit;
  };

  void makeWindow(const std::optional<LayerRange>& slab);
  void follow(Ray ray);
  Mark* markOf(const Voxel& voxel);

  Eigen::Vector3f sensor_;
  std::vector<Ray> rays_;
  CellBox window_;
  LayerRange slab_;
  std::vector<Mark> marks_;
};

}  // namespace mrpt_sgraphs
