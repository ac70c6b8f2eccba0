// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/thinning.h"

#include <cmath>

#include "mrpt_sgraphs/geometry/cell_key.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
constexpr std::size_t kFewest = 1024;

std::size_t slotOf(std::uint64_t key, std::size_t slots) {
  return ((key * 0x9E3779B97F4A7C15ULL) >> 20) & (slots - 1);
}

}  // namespace

VoxelSet::VoxelSet(double edge_m, std::size_t expected)
    : inverse_edge_(static_cast<float>(1.0 / edge_m)) {
  std::size_t slots = kFewest;
  while (slots < 2 * expected) slots *= 2;
  slots_.assign(slots, kEmpty);
}

bool VoxelSet::insert(const Eigen::Vector3f& p) {
  const auto index = [this](float v) { return static_cast<int>(std::floor(v * inverse_edge_)); };
  if (!insertKey(cellKey(index(p.x()), index(p.y()), index(p.z())))) return false;
  if (2 * ++count_ > slots_.size()) grow();
  return true;
}

bool VoxelSet::insertKey(std::uint64_t key) {
  std::size_t slot = slotOf(key, slots_.size());
  while (slots_[slot] != kEmpty && slots_[slot] != key) slot = (slot + 1) & (slots_.size() - 1);
  if (slots_[slot] == key) return false;
  slots_[slot] = key;
  return true;
}

void VoxelSet::grow() {
  std::vector<std::uint64_t> old(2 * slots_.size(), kEmpty);
  old.swap(slots_);
  for (const std::uint64_t key : old) {
    if (key != kEmpty) insertKey(key);
  }
}

std::vector<int> firstInVoxels(const Cloud& cloud, double voxel_size_m) {
  VoxelSet voxels(voxel_size_m, cloud.size());
  std::vector<int> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (voxels.insert(cloud[i].getVector3fMap())) kept.push_back(static_cast<int>(i));
  }
  return kept;
}

Cloud::Ptr thinned(const Cloud& cloud, double voxel_size_m) {
  Cloud::Ptr result(new Cloud);
  result->header = cloud.header;
  result->sensor_origin_ = cloud.sensor_origin_;
  result->sensor_orientation_ = cloud.sensor_orientation_;
  for (const int i : firstInVoxels(cloud, voxel_size_m)) {
    result->push_back(cloud[static_cast<std::size_t>(i)]);
  }
  return result;
}

}  // namespace mrpt_sgraphs
