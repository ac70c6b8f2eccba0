// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/map_cloud.h"

#include "mrpt_sgraphs/frontend/thinning.h"

namespace mrpt_sgraphs {

Cloud::Ptr mapCloud(const GraphSnapshot& graph, double resolution_m) {
  Cloud::Ptr map(new Cloud);
  map->header.stamp = toPclStamp(graph.stamp_s);
  const bool thin = resolution_m > 0.0;
  VoxelSet voxels(thin ? resolution_m : 1.0);
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (keyframe.cloud == nullptr) continue;
    for (const Point& point : *keyframe.cloud) {
      const Eigen::Vector3d p = keyframe.T_map_base * point.getVector3fMap().cast<double>();
      if (thin && !voxels.insert(p.cast<float>())) continue;
      Point placed = point;
      placed.getVector3fMap() = p.cast<float>();
      placed.time = 0.0F;
      map->push_back(placed);
    }
  }
  return map;
}

}  // namespace mrpt_sgraphs
