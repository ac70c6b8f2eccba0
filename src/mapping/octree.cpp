// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/octree.h"

namespace mrpt_sgraphs {
namespace {

/// OctoMap's key of the voxel from 0 to one edge.
constexpr int kKeyOfZero = 32768;

octomap::key_type keyOf(int index) { return static_cast<octomap::key_type>(index + kKeyOfZero); }

}  // namespace

std::unique_ptr<octomap::OcTree> octreeOf(const OccupancyMap& map) {
  auto tree = std::make_unique<octomap::OcTree>(map.cell_m());
  const float occupied = tree->getClampingThresMaxLog();
  const float free = tree->getClampingThresMinLog();
  constexpr bool kLazily = true;
  map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    const octomap::OcTreeKey key(keyOf(voxel[0]), keyOf(voxel[1]), keyOf(voxel[2]));
    tree->setNodeValue(key, is_occupied ? occupied : free, kLazily);
  });
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

}  // namespace mrpt_sgraphs
