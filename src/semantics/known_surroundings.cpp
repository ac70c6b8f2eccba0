// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/known_surroundings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mrpt_sgraphs/frontend/thinning.h"
#include "mrpt_sgraphs/geometry/cell_set.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes that stand farther up or down are of another level.
constexpr double kOneLevel_m = 1.5;
/// Of what a wall that has no cloud any more is made.
constexpr double kWallCell_m = 0.15;
/// From so far before it a wall was seen.
constexpr double kBefore_m = 1.0;
constexpr double kRegistrationVoxel_m = 0.2;
constexpr std::size_t kRegistrationPoints = 2500;

std::vector<const KeyframeNode*> nearest(const GraphSnapshot& map, const Eigen::Vector3d& place_map,
                                         std::size_t count) {
  std::vector<std::pair<double, const KeyframeNode*>> near;
  for (const KeyframeNode& keyframe : map.keyframes) {
    const Eigen::Vector3d way = keyframe.T_map_base.translation() - place_map;
    if (keyframe.cloud == nullptr || std::abs(way.z()) > kOneLevel_m) continue;
    near.emplace_back(way.norm(), &keyframe);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const KeyframeNode*> keyframes;
  for (std::size_t k = 0; k < std::min(count, near.size()); ++k) {
    keyframes.push_back(near[k].second);
  }
  return keyframes;
}

/// Points of a surface, where the map has nothing of its own.
void fill(const PlanarExtent& extent, const Plane& plane, const Eigen::Vector3d& place_map,
          double radius_m, std::vector<Eigen::Vector3d>* points, const VoxelMap& map) {
  if (extent.outline.size() < 3) return;
  const PlaneFrame frame(plane, extent.outline.front());
  const Eigen::Vector3d before = kBefore_m * plane.normal;
  rasterized(flattened(extent, frame), kWallCell_m).forEach([&](Cell cell) {
    const Eigen::Vector3d point =
        frame.lifted({(cell.column + 0.5) * kWallCell_m, (cell.row + 0.5) * kWallCell_m});
    if ((point - place_map).norm() > radius_m) return;
    if (map.find(point, point + before, 0) == nullptr) points->push_back(point);
  });
}

}  // namespace

VoxelMap surroundingsOf(const GraphSnapshot& map, const Eigen::Vector3d& place_map,
                        const SurroundingsConfig& config) {
  VoxelMap voxels(config.map);
  for (const KeyframeNode* keyframe :
       nearest(map, place_map, static_cast<std::size_t>(config.keyframes))) {
    const Eigen::Vector3d viewpoint = keyframe->T_map_base * viewpointOf(*keyframe->cloud);
    for (const Point& p : *keyframe->cloud) {
      voxels.insert(keyframe->T_map_base * Eigen::Vector3d(p.getVector3fMap().cast<double>()),
                    viewpoint);
    }
  }
  voxels.refit();

  const auto add = [&](const PlanarExtent& extent, const Plane& plane) {
    std::vector<Eigen::Vector3d> points;
    fill(extent, plane, place_map, config.radius_m, &points, voxels);
    for (const Eigen::Vector3d& point : points) {
      voxels.insert(point, point + kBefore_m * plane.normal);
    }
  };
  for (const WallNode& wall : map.walls) add(wall.extent_map, wall.plane_map);
  for (const RoomNode& room : map.rooms) {
    const auto floor = std::find_if(map.floors.begin(), map.floors.end(), [&room](const auto& each) {
      return room.floor == each.id;
    });
    if (floor != map.floors.end()) add(room.extent_map, floor->ground_map);
  }
  voxels.refit();
  return voxels;
}

const KeyframeNode* nearestKeyframe(const GraphSnapshot& map, const Eigen::Vector3d& place_map) {
  const auto with_clouds = nearest(map, place_map, 1);
  if (!with_clouds.empty()) return with_clouds.front();
  const KeyframeNode* best = nullptr;
  double best_m = 0.0;
  for (const KeyframeNode& keyframe : map.keyframes) {
    const double distance_m = (keyframe.T_map_base.translation() - place_map).norm();
    if (best != nullptr && distance_m >= best_m) continue;
    best = &keyframe;
    best_m = distance_m;
  }
  return best;
}

std::vector<ScanPoint> registrationPoints(const Cloud& cloud) {
  const std::vector<int> kept = firstInVoxels(cloud, kRegistrationVoxel_m);
  const std::size_t stride = kept.size() / kRegistrationPoints + 1;
  std::vector<ScanPoint> points;
  for (std::size_t i = 0; i < kept.size(); i += stride) {
    const Point& p = cloud[static_cast<std::size_t>(kept[i])];
    points.push_back({p.getVector3fMap().cast<double>(), 0.0});
  }
  return points;
}

}  // namespace mrpt_sgraphs
