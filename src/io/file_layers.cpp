// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/file_layers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace mrpt_sgraphs {
namespace {

/// How high the floors lie [m]: as the lowest keyframe of each.
std::map<FloorId, double> heightsOf(const GraphFile& file) {
  std::map<FloorId, double> heights_m;
  for (const GraphFile::Keyframe& keyframe : file.keyframes) {
    if (!keyframe.floor) continue;
    const double z_m = keyframe.T_map_base.translation().z();
    const auto [entry, is_new] = heights_m.emplace(*keyframe.floor, z_m);
    if (!is_new) entry->second = std::min(entry->second, z_m);
  }
  return heights_m;
}

Eigen::Vector3d onFloor(const Eigen::Vector2d& place_map, FloorId floor,
                        const std::map<FloorId, double>& heights_m) {
  const auto found = heights_m.find(floor);
  return {place_map.x(), place_map.y(), found == heights_m.end() ? 0.0 : found->second};
}

}  // namespace

LayeredGraph layersOf(const GraphFile& file) {
  LayeredGraph graph;
  const std::map<FloorId, double> heights_m = heightsOf(file);
  for (const GraphFile::Keyframe& keyframe : file.keyframes) {
    KeyframeAttributes attributes;
    attributes.room = keyframe.room;
    attributes.floor = keyframe.floor;
    graph.restoreKeyframe(keyframe.id, keyframe.T_map_base, attributes);
  }
  for (const GraphFile::Wall& wall : file.walls) graph.restoreWall(wall.id, wall.plane_map, {});
  for (const GraphFile::Floor& floor : file.floors) {
    FloorAttributes attributes;
    attributes.centre_map = onFloor(floor.centre_map, floor.id, heights_m);
    const Plane ground_map{Eigen::Vector3d::UnitZ(), attributes.centre_map.z()};
    graph.restoreFloor(floor.id, ground_map, attributes);
  }
  for (const GraphFile::Room& room : file.rooms) {
    RoomAttributes attributes;
    attributes.walls = room.walls;
    attributes.floor = room.floor;
    double heading_rad = 0.0;
    if (!room.walls.empty()) {
      const Eigen::Vector3d normal = graph.plane(room.walls.front()).normal;
      heading_rad = std::atan2(normal.y(), normal.x());
    }
    Pose T_map_room = Pose::Identity();
    T_map_room.translation() = onFloor(room.centre_map, room.floor, heights_m);
    T_map_room.linear() =
        Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    graph.restoreRoom(room.id, T_map_room, attributes);
  }
  for (const FactorConstPtr& factor : file.factors) graph.addFactor(factor);
  return graph;
}

}  // namespace mrpt_sgraphs
