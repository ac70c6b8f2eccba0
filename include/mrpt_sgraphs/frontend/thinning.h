// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/geometry/point_cloud.h"

namespace mrpt_sgraphs {

/// The voxels of a grid that have been seen: PCL's VoxelGrid averages, and so bends edges, and costs
/// five times as much as asking whether a voxel is new.
class VoxelSet {
 public:
  /// @param edge_m    Of a voxel.
  /// @param expected  How many points are to come; more are welcome.
  explicit VoxelSet(double edge_m, std::size_t expected = 0);

  /// @param p  Within a million voxels of the origin [m].
  /// @return Whether the voxel of the point was empty so far.
  bool insert(const Eigen::Vector3f& p);

 private:
  bool insertKey(std::uint64_t key);
  void grow();

  float inverse_edge_;
  std::size_t count_ = 0;
  std::vector<std::uint64_t> slots_;  ///< Open addressing, a power of two of them.
};

/// The indices of the first point in every voxel of the given edge [m], in the cloud's order.
std::vector<int> firstInVoxels(const Cloud& cloud, double voxel_size_m);

/// The cloud with one point a voxel; header and sensor origin are kept.
Cloud::Ptr thinned(const Cloud& cloud, double voxel_size_m);

}  // namespace mrpt_sgraphs
