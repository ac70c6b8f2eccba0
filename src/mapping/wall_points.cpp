// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/wall_points.h"

#include <cmath>
#include <map>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/frontend/thinning.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/mapping/node_colour.h"

namespace mrpt_sgraphs {
namespace {

/// A wall that points are collected for.
struct Collector {
  const WallNode* wall;
  PlaneFrame frame;
  FlatExtent extent;
  VoxelSet voxels;
  pcl::PointXYZRGB colour;

  Collector(const WallNode& node, const Eigen::Vector3d& corner, double voxel_m)
      : wall(&node),
        frame(node.plane_map, corner),
        extent(flattened(node.extent_map, frame)),
        voxels(voxel_m) {
    const Eigen::Vector3f rgb = 255.0F * colourOf(node.id);
    colour.r = static_cast<uint8_t>(std::lround(rgb[0]));
    colour.g = static_cast<uint8_t>(std::lround(rgb[1]));
    colour.b = static_cast<uint8_t>(std::lround(rgb[2]));
  }
};

using Collectors = std::map<WallId, Collector>;

std::map<KeyframeId, std::vector<Collector*>> wallsOfKeyframes(const GraphSnapshot& graph,
                                                               Collectors* collectors) {
  std::map<KeyframeId, std::vector<Collector*>> walls;
  for (const StoredFactor& stored : graph.factors) {
    const auto* sight = dynamic_cast<const PlaneObservationFactor*>(stored.factor.get());
    if (sight == nullptr || sight->node(1).layer != Layer::kWall) continue;
    const auto found = collectors->find(WallId{sight->node(1).value});
    if (found == collectors->end()) continue;
    walls[KeyframeId{sight->node(0).value}].push_back(&found->second);
  }
  return walls;
}

/// The wall that the point of the map lies on, or null.
Collector* wallAt(const Eigen::Vector3d& p, const std::vector<Collector*>& walls,
                  double max_distance_m) {
  Collector* nearest = nullptr;
  double nearest_m = max_distance_m;
  for (Collector* candidate : walls) {
    const Plane& plane = candidate->wall->plane_map;
    const double distance_m = std::abs(plane.normal.dot(p) - plane.distance);
    if (distance_m > nearest_m || !contains(candidate->extent, candidate->frame.flat(p))) continue;
    nearest = candidate;
    nearest_m = distance_m;
  }
  return nearest;
}

}  // namespace

ColouredCloud::Ptr wallPoints(const GraphSnapshot& graph, const WallPointsConfig& config) {
  const bool thin = config.resolution_m > 0.0;
  Collectors collectors;
  for (const WallNode& wall : graph.walls) {
    const Outline3& outline = wall.extent_map.outline;
    if (outline.empty()) continue;
    collectors.try_emplace(wall.id, wall, outline.front(), thin ? config.resolution_m : 1.0);
  }
  const auto walls_of = wallsOfKeyframes(graph, &collectors);

  ColouredCloud::Ptr cloud(new ColouredCloud);
  cloud->header.stamp = toPclStamp(graph.stamp_s);
  for (const KeyframeNode& keyframe : graph.keyframes) {
    const auto walls = walls_of.find(keyframe.id);
    if (keyframe.cloud == nullptr || walls == walls_of.end()) continue;
    for (const Point& point : *keyframe.cloud) {
      const Eigen::Vector3d p = keyframe.T_map_base * point.getVector3fMap().cast<double>();
      Collector* const wall = wallAt(p, walls->second, config.max_distance_m);
      if (wall == nullptr || (thin && !wall->voxels.insert(p.cast<float>()))) continue;
      cloud->push_back(wall->colour);
      cloud->back().getVector3fMap() = p.cast<float>();
    }
  }
  return cloud;
}

}  // namespace mrpt_sgraphs
