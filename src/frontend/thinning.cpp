// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/thinning.h"

#include <cmath>
#include <cstdint>

namespace mrpt_sgraphs {

std::vector<int> firstInVoxels(const Cloud& cloud, double voxel_size_m) {
  // A set of voxels by open addressing: PCL's VoxelGrid averages (and so bends edges) and costs five
  // times as much.
  std::size_t capacity = 1024;
  while (capacity < 2 * cloud.size()) capacity *= 2;
  const std::size_t mask = capacity - 1;
  constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  std::vector<std::uint64_t> voxels(capacity, kEmpty);

  std::vector<int> kept;
  const float inverse = static_cast<float>(1.0 / voxel_size_m);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud[i];
    const auto part = [inverse](float v) {
      constexpr int kOffset = 1 << 20;  // 21 bits a coordinate
      return static_cast<std::uint64_t>(static_cast<int>(std::floor(v * inverse)) + kOffset) &
             0x1FFFFF;
    };
    const std::uint64_t key = (part(p.x) << 42) | (part(p.y) << 21) | part(p.z);
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> 20 & mask;
    while (voxels[slot] != kEmpty && voxels[slot] != key) slot = (slot + 1) & mask;
    if (voxels[slot] == key) continue;
    voxels[slot] = key;
    kept.push_back(static_cast<int>(i));
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
