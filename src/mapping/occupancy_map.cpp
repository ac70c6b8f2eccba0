// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/occupancy_map.h"

#include <algorithm>

#include "mrpt_sgraphs/geometry/cell_key.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kHit = 3;
constexpr int kMiss = -1;
constexpr int kMost = 32000;
constexpr double kTolerance = 0.25;     ///< Of a cell.
constexpr double kFarthest = 30000.0;  ///< Cells; OctoMap's keys end at 32768.

/// Which of the blocks of eight voxels a voxel is in.
int blockOf(int voxel) { return voxel >> 3; }
int placeIn(int voxel) { return voxel & 7; }

}  // namespace

OccupancyMap::OccupancyMap(const MapConfig& config)
    : config_(config), placed_(kTolerance * config.cell_m) {}

bool OccupancyMap::update(const GraphSnapshot& graph) {
  return placed_.update(
      graph.keyframes, Pose::Identity(),
      [this](const Cloud& cloud, const Pose& T_map_base) { count(cloud, T_map_base, 1); },
      [this](const Cloud& cloud, const Pose& T_map_base) { count(cloud, T_map_base, -1); });
}

void OccupancyMap::count(const Cloud& cloud_base, const Pose& T_map_base, int sign) {
  const double reach_m = kFarthest * config_.cell_m - config_.max_range_m;
  if (!(T_map_base.translation().cwiseAbs().maxCoeff() < reach_m)) return;
  marks_.cast(cloud_base, T_map_base, {config_.cell_m, config_.max_range_m, config_.max_rays},
              std::nullopt);
  CellKey last = 0;
  Block* block = nullptr;
  marks_.forEach([&](const Voxel& voxel, bool is_hit) {
    const CellKey key = cellKey(blockOf(voxel[0]), blockOf(voxel[1]), blockOf(voxel[2]));
    if (block == nullptr || key != last) block = &blocks_[key];
    last = key;
    int16_t& evidence = block->evidence[static_cast<std::size_t>(
        (placeIn(voxel[2]) * kEdge + placeIn(voxel[1])) * kEdge + placeIn(voxel[0]))];
    const int before = evidence;
    const int now = std::clamp(before + sign * (is_hit ? kHit : kMiss), -kMost, kMost);
    evidence = static_cast<int16_t>(now);
    block->known += (now != 0 ? 1 : 0) - (before != 0 ? 1 : 0);
    if (block->known > 0) return;
    blocks_.erase(key);
    block = nullptr;
  });
}

int OccupancyMap::evidenceAt(const Voxel& voxel) const {
  const auto block = blocks_.find(cellKey(blockOf(voxel[0]), blockOf(voxel[1]), blockOf(voxel[2])));
  if (block == blocks_.end()) return 0;
  return block->second.evidence[static_cast<std::size_t>(
      (placeIn(voxel[2]) * kEdge + placeIn(voxel[1])) * kEdge + placeIn(voxel[0]))];
}

std::size_t OccupancyMap::size() const {
  std::size_t known = 0;
  for (const auto& [key, block] : blocks_) known += static_cast<std::size_t>(block.known);
  return known;
}

std::vector<std::pair<Voxel, const OccupancyMap::Block*>> OccupancyMap::inOrder() const {
  std::vector<std::pair<Voxel, const Block*>> blocks;
  blocks.reserve(blocks_.size());
  for (const auto& [key, block] : blocks_) {
    const Voxel index = cellIndexOf(key);
    blocks.push_back({{index[0] * kEdge, index[1] * kEdge, index[2] * kEdge}, &block});
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return blocks;
}

}  // namespace mrpt_sgraphs
