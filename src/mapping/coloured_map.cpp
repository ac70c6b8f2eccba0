// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/coloured_map.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/thinning.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/mapping/node_colour.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kStorey_m = 3.0;  ///< Of rooms whose height is not known.

pcl::PointXYZRGB colouredBy(const Eigen::Vector3f& rgb) {
  pcl::PointXYZRGB point;
  point.r = static_cast<uint8_t>(std::lround(255.0F * rgb[0]));
  point.g = static_cast<uint8_t>(std::lround(255.0F * rgb[1]));
  point.b = static_cast<uint8_t>(std::lround(255.0F * rgb[2]));
  return point;
}

/// What stands on the ground of a room.
struct RoomSpace {
  PlaneFrame ground;
  FlatExtent extent;
  double height_m;
  pcl::PointXYZRGB colour;

  explicit RoomSpace(const RoomNode& room)
      : ground({room.T_map_room.linear().col(2),
                room.T_map_room.linear().col(2).dot(room.T_map_room.translation())},
               room.T_map_room.translation()),
        extent(flattened(room.extent_map, ground)),
        height_m(room.height_m > 0.0 ? room.height_m : kStorey_m),
        colour(colouredBy(colourOf(room.id))) {}

  bool contains(const Eigen::Vector3d& point_map) const {
    constexpr double kMargin_m = 0.5;  // below the ground and above the walls
    const double up_m = ground.normal.dot(point_map - ground.origin);
    return up_m > -kMargin_m && up_m < height_m + kMargin_m &&
           mrpt_sgraphs::contains(extent, ground.flat(point_map));
  }
};

}  // namespace

ColouredCloud::Ptr mapByRooms(const GraphSnapshot& graph, double resolution_m) {
  std::vector<RoomSpace> rooms;
  for (const RoomNode& room : graph.rooms) {
    if (!room.extent_map.outline.empty()) rooms.emplace_back(room);
  }
  const pcl::PointXYZRGB grey = colouredBy({0.6F, 0.6F, 0.6F});
  const bool thin = resolution_m > 0.0;
  VoxelSet voxels(thin ? resolution_m : 1.0);
  ColouredCloud::Ptr map(new ColouredCloud);
  map->header.stamp = toPclStamp(graph.stamp_s);
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (keyframe.cloud == nullptr) continue;
    const Eigen::Vector3d sensor_map = keyframe.T_map_base * viewpointOf(*keyframe.cloud);
    for (const Point& point : *keyframe.cloud) {
      const Eigen::Vector3d p = keyframe.T_map_base * point.getVector3fMap().cast<double>();
      if (thin && !voxels.insert(p.cast<float>())) continue;
      // a wall bounds the room that its ray came through
      constexpr double kBefore_m = 0.15;
      const Eigen::Vector3d before = p + kBefore_m * (sensor_map - p).normalized();
      const RoomSpace* of = nullptr;
      for (const RoomSpace& room : rooms) {
        if (of == nullptr && room.contains(before)) of = &room;
      }
      map->push_back(of != nullptr ? of->colour : grey);
      map->back().getVector3fMap() = p.cast<float>();
    }
  }
  return map;
}

GraphSnapshot onFloor(const GraphSnapshot& graph, const std::string& name) {
  const FloorNode* found = nullptr;
  std::string known;
  for (const FloorNode& floor : graph.floors) {
    const std::string id = std::to_string(floor.id.value);
    if (name == id || (!floor.name.empty() && name == floor.name)) found = &floor;
    known += (known.empty() ? "" : ", ") + id + (floor.name.empty() ? "" : " (" + floor.name + ")");
  }
  if (found == nullptr) {
    throw std::invalid_argument("there is no floor '" + name + "', but " +
                                (known.empty() ? "none at all" : known));
  }
  GraphSnapshot result = graph;
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    if (graph.keyframes[k].floor != found->id) result.keyframes.edit(k).cloud.reset();
  }
  return result;
}

}  // namespace mrpt_sgraphs
