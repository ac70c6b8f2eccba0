// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <octomap/OcTree.h>

#include <cstdint>

#include "mrpt_sgraphs/geometry/cell_grid.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"
#include "mrpt_sgraphs/mapping/free_space_config.h"
#include "mrpt_sgraphs/mapping/ray_marks.h"

namespace mrpt_sgraphs {

/// What the rays of a storey's keyframes have crossed and hit: an OctoMap of the slab above its
/// ground, and its view from above.
///
/// A ray tells of each voxel of the slab that it was free or, at its end, occupied, once a cloud. A
/// hit weighs as much as three misses. Evidence is summed in multiples of 1/64, exactly, so what
/// was added can be taken out again: a keyframe that has moved is removed where it was and added
/// where it is. Beyond 780 hits or 2350 misses of one voxel OctoMap counts no further, and what is
/// then taken out leaves that voxel the less certain.
///
/// Frame: `floor`, z up and zero on the storey's ground.
class FreeSpace {
 public:
  enum class Space : uint8_t { kUnknown, kFree, kOccupied };

  explicit FreeSpace(const FreeSpaceConfig& config);

  void add(const Cloud& cloud_base, const Pose& T_floor_base) {
    count(cloud_base, T_floor_base, 1.0F);
  }

  /// What was added with the same values before.
  void remove(const Cloud& cloud_base, const Pose& T_floor_base) {
    count(cloud_base, T_floor_base, -1.0F);
  }

  /// A column of the slab: occupied where a wall or tall furniture stands in it; a table alone does
  /// not.
  Space at(Cell cell) const;
  /// Around all that is known.
  const CellBox& box() const { return known_; }
  /// Of which nothing is left, maybe.
  void extendBox(const CellBox& known) { known_ = known_.united(known); }
  double cell_m() const { return config_.cell_m; }

  /// The voxels of the slab: unknown again where the log-odds are zero; inner nodes are not up to
  /// date.
  const octomap::OcTree& tree() const { return tree_; }

 private:
  struct Column {
    int16_t free = 0;  ///< Voxels.
    int16_t occupied = 0;
  };

  void count(const Cloud& cloud_base, const Pose& T_floor_base, float sign);
  void weigh(const octomap::OcTreeKey& key, float delta);

  FreeSpaceConfig config_;
  octomap::OcTree tree_;
  CellGrid<Column> columns_;
  CellBox known_;
  LayerRange slab_;
  RayMarks marks_;  ///< Of the cloud that is being added.
};

}  // namespace mrpt_sgraphs
