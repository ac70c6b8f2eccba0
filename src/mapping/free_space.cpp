// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/free_space.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

/// Multiples of 1/64: sums of them are exact, and 36, where OctoMap's log-odds are cut off here, is
/// hundreds of clouds away.
constexpr float kHit = 3.0F / 64.0F;
constexpr float kMiss = -1.0F / 64.0F;
constexpr double kCutOff = 1e-16;  ///< As a probability.

/// OctoMap's key of the voxel from 0 to one edge.
constexpr int kKeyOfZero = 32768;

octomap::key_type keyOf(int index) { return static_cast<octomap::key_type>(index + kKeyOfZero); }

}  // namespace

FreeSpace::FreeSpace(const FreeSpaceConfig& config) : config_(config), tree_(config.cell_m) {
  tree_.setClampingThresMin(kCutOff);
  tree_.setClampingThresMax(1.0 - kCutOff);
  slab_.bottom = static_cast<int>(std::floor(config.min_height_m / config.cell_m + 0.5));
  const int top = static_cast<int>(std::floor(config.max_height_m / config.cell_m + 0.5));
  slab_.layers = std::max(1, top - slab_.bottom);
}

void FreeSpace::weigh(const octomap::OcTreeKey& key, float delta) {
  constexpr bool kLazily = true;
  // updateNode searches for it and then comes down to it a second time
  octomap::OcTreeNode* leaf = tree_.search(key);
  if (leaf != nullptr) {
    tree_.updateNodeLogOdds(leaf, delta);
  } else {
    leaf = tree_.updateNode(key, delta, kLazily);
  }
  const float now = leaf->getLogOdds();
  const float before = now - delta;
  Column& column = columns_[{key[0] - kKeyOfZero, key[1] - kKeyOfZero}];
  if (before < 0.0F) --column.free;
  if (before > 0.0F) --column.occupied;
  if (now < 0.0F) ++column.free;
  if (now > 0.0F) ++column.occupied;
}

void FreeSpace::count(const Cloud& cloud_base, const Pose& T_floor_base, float sign) {
  marks_.cast(cloud_base, T_floor_base, {config_.cell_m, config_.max_range_m, config_.max_rays},
              slab_);
  columns_.cover(marks_.window());
  marks_.forEach([&](const Voxel& voxel, bool is_hit) {
    weigh({keyOf(voxel[0]), keyOf(voxel[1]), keyOf(voxel[2])}, sign * (is_hit ? kHit : kMiss));
    const Cell cell{voxel[0], voxel[1]};
    known_ = known_.united({cell, cell});
  });
}

FreeSpace::Space FreeSpace::at(Cell cell) const {
  const Column column = columns_.valueOr(cell, {});
  // the top of a table is one voxel thick, with free ones above and below
  constexpr int kFreePerOccupied = 3;
  if (column.occupied > 0 && kFreePerOccupied * column.occupied >= column.free) {
    return Space::kOccupied;
  }
  return column.free > 0 ? Space::kFree : Space::kUnknown;
}

}  // namespace mrpt_sgraphs
