// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kStep_m = 0.5;          ///< A place this far below a ground is still on it.
constexpr double kUsualHeight_m = 2.5;   ///< Of a room whose walls nobody has seen the top of.
constexpr double kHighest = std::numeric_limits<double>::infinity();

double heightAbove(const Plane& ground_map, const Eigen::Vector3d& place_map) {
  return ground_map.normal.dot(place_map) - ground_map.distance;
}

/// Above the room's own ground.
double heightIn(const RoomNode& room, const Eigen::Vector3d& place_map) {
  return (room.T_map_room.inverse() * place_map).z();
}

bool isWithin(const RoomNode& room, const Eigen::Vector3d& place_map) {
  const double height_m = heightIn(room, place_map);
  const double top_m = (room.height_m > 0.0 ? room.height_m : kUsualHeight_m) + kStep_m;
  return height_m >= -kStep_m && height_m <= top_m && isAround(room, place_map);
}

Eigen::Vector3d levelled(const Eigen::Vector3d& v) { return {v.x(), v.y(), 0.0}; }

const FloorNode* floorBelow(const GraphSnapshot& graph, const Eigen::Vector3d& place_map) {
  const FloorNode* below = nullptr;
  double least_m = kHighest;
  for (const FloorNode& floor : graph.floors) {
    const double height_m = heightAbove(floor.ground_map, place_map);
    if (height_m < -kStep_m || height_m >= least_m) continue;
    least_m = height_m;
    below = &floor;
  }
  return below;
}

void findNearest(const GraphSnapshot& graph, const Eigen::Vector3d& place_map, Place* place) {
  place->distance_m = kHighest;
  for (const RoomNode& room : graph.rooms) {
    if (place->floor != nullptr && room.floor != place->floor->id) continue;
    const auto border = nearestBorder(room, place_map);
    if (!border || border->distance_m >= place->distance_m) continue;
    place->nearest = &room;
    place->distance_m = border->distance_m;
  }
}

template <typename Nodes, typename AnyId>
auto findIn(const Nodes& nodes, AnyId id) {
  const auto found =
      std::find_if(nodes.begin(), nodes.end(), [id](const auto& node) { return node.id == id; });
  return found == nodes.end() ? nullptr : &*found;
}

}  // namespace

double areaOf(const RoomNode& room) {
  if (room.extent_map.outline.size() < 3) return 0.0;
  const PlaneFrame from_above(Plane{}, room.extent_map.outline.front());
  return std::abs(areaOf(flattened(room.extent_map, from_above)));
}

bool isAround(const RoomNode& room, const Eigen::Vector3d& place_map) {
  if (room.extent_map.outline.size() < 3) return false;
  const PlaneFrame frame(Plane{}, room.extent_map.outline.front());
  return contains(flattened(room.extent_map, frame), frame.flat(place_map));
}

std::optional<RoomBorder> nearestBorder(const RoomNode& room, const Eigen::Vector3d& place_map) {
  const Outline3& outline = room.extent_map.outline;
  std::optional<RoomBorder> nearest;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector3d& begin = outline[k];
    const Eigen::Vector3d edge = outline[(k + 1) % outline.size()] - begin;
    const Eigen::Vector3d level = levelled(edge);
    if (level.norm() == 0.0) continue;
    const double share =
        std::clamp(level.dot(levelled(place_map - begin)) / level.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector3d point = begin + share * edge;
    const double distance_m = levelled(place_map - point).norm();
    if (nearest && distance_m >= nearest->distance_m) continue;
    nearest = RoomBorder{point, level.normalized(), distance_m};
  }
  return nearest;
}

Place placeOf(const GraphSnapshot& graph, const Eigen::Vector3d& place_map) {
  Place place;
  double least_m = kHighest;
  for (const RoomNode& room : graph.rooms) {  // of storeys above each other the upper one
    if (!isWithin(room, place_map) || heightIn(room, place_map) >= least_m) continue;
    least_m = heightIn(room, place_map);
    place.room = &room;
  }
  if (place.room != nullptr && place.room->floor) place.floor = findFloor(graph, *place.room->floor);
  if (place.floor == nullptr) place.floor = floorBelow(graph, place_map);
  if (place.room == nullptr) findNearest(graph, place_map, &place);
  return place;
}

std::vector<const RoomNode*> roomsNamed(const GraphSnapshot& graph, const std::string& name) {
  std::vector<const RoomNode*> rooms;
  for (const RoomNode& room : graph.rooms) {
    if (room.name == name) rooms.push_back(&room);
  }
  return rooms;
}

const RoomNode* findRoom(const GraphSnapshot& graph, RoomId id) { return findIn(graph.rooms, id); }

const FloorNode* findFloor(const GraphSnapshot& graph, FloorId id) {
  return findIn(graph.floors, id);
}

}  // namespace mrpt_sgraphs
