// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/building_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "json_place.h"

namespace mrpt_sgraphs {
namespace {

TrueWall wallFrom(const JsonPlace& place, std::size_t index) {
  TrueWall wall;
  wall.id = place.has("id") ? place["id"].id() : index;
  wall.extent = place.extent();
  if (place.has("normal")) {
    wall.plane = Plane{place["normal"].unitVector(), place["distance"].number()};
  }
  if (place.has("seen_m2")) wall.seen_m2 = place["seen_m2"].number();
  return wall;
}

TrueRoom::Kind kindOf(const JsonPlace& place) {
  const std::string kind = place.string();
  if (kind == "room") return TrueRoom::Kind::kRoom;
  if (kind == "corridor") return TrueRoom::Kind::kCorridor;
  if (kind == "stairwell") return TrueRoom::Kind::kStairwell;
  place.fail("is none of room, corridor, stairwell");
}

TrueRoom roomFrom(const JsonPlace& place, std::size_t index) {
  TrueRoom room;
  room.id = place.has("id") ? place["id"].id() : index;
  if (place.has("name")) room.name = place["name"].string();
  if (place.has("kind")) room.kind = kindOf(place["kind"]);
  room.extent = place.extent();
  if (room.extent.outline.size() < 3) place["polygon"].fail("has fewer than 3 corners");
  if (place.has("height")) room.height_m = place["height"].number();
  if (place.has("entered")) room.entered = place["entered"].boolean();
  return room;
}

PlanarExtent raised(const PlanarExtent& extent, double height_m) {
  return mapped(extent, [height_m](const Eigen::Vector3d& corner) -> Eigen::Vector3d {
    return corner + height_m * Eigen::Vector3d::UnitZ();
  });
}

void addSurface(const PlanarExtent& extent, TrueBuilding* building) {
  building->surfaces.emplace_back(extent.outline, extent.holes);
}

/// The sides and the top of what stands on a footprint.
void addObstacle(const JsonPlace& place, TrueBuilding* building) {
  const PlanarExtent foot = place.extent();
  if (foot.outline.size() < 3) place["polygon"].fail("has fewer than 3 corners");
  const double height_m = place["height"].number();
  if (!(height_m > 0.0)) place["height"].fail("must be positive");
  const PlanarExtent top = raised(foot, height_m);
  addSurface(top, building);
  for (std::size_t k = 0; k < foot.outline.size(); ++k) {
    const std::size_t next = (k + 1) % foot.outline.size();
    addSurface({{foot.outline[k], foot.outline[next], top.outline[next], top.outline[k]}, {}},
               building);
  }
}

TrueBuilding buildingFrom(const JsonPlace& document) {
  TrueBuilding building;
  const JsonPlace walls = document["walls"];
  for (std::size_t k = 0; k < walls.size(); ++k) {
    addSurface(building.walls.emplace_back(wallFrom(walls[k], k)).extent, &building);
  }
  const JsonPlace rooms = document["rooms"];
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    const TrueRoom& room = building.rooms.emplace_back(roomFrom(rooms[k], k));
    addSurface(room.extent, &building);
    if (room.height_m) addSurface(raised(room.extent, *room.height_m), &building);
  }
  if (building.surfaces.empty()) throw std::runtime_error("it has no walls and no rooms");
  if (document.has("obstacles")) {
    const JsonPlace obstacles = document["obstacles"];
    for (std::size_t k = 0; k < obstacles.size(); ++k) addObstacle(obstacles[k], &building);
  }
  if (!document.has("floors")) return building;
  const JsonPlace floors = document["floors"];
  for (std::size_t k = 0; k < floors.size(); ++k) {
    const uint64_t id = floors[k].has("id") ? floors[k]["id"].id() : k;
    building.floors.push_back({id, floors[k]["elevation"].number()});
  }
  return building;
}

TrueRoom boxFrom(const JsonPlace& place, std::size_t index) {
  const Eigen::Vector3d min = place["min"].vector(3);
  const Eigen::Vector3d max = place["max"].vector(3);
  if (!(min.array() < max.array()).all()) place["max"].fail("is not above min");
  TrueRoom room;
  room.id = index;
  room.name = place["name"].string();
  room.extent.outline = {
      min, {max.x(), min.y(), min.z()}, {max.x(), max.y(), min.z()}, {min.x(), max.y(), min.z()}};
  room.height_m = max.z() - min.z();
  return room;
}

void addFloorAt(double elevation_m, std::vector<TrueFloor>* floors) {
  constexpr double kOneFloor_m = 0.3;
  for (const TrueFloor& floor : *floors) {
    if (std::abs(floor.elevation_m - elevation_m) <= kOneFloor_m) return;
  }
  floors->push_back({floors->size(), elevation_m});
}

/// What `read` makes of a file of JSON; whatever is wrong with it is told with the file's name.
template <typename Read>
void readJsonFile(const std::string& path, const char* name, const Read& read) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));
  try {
    const Json json = Json::parse(file);
    read(JsonPlace(json, name));
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read '" + path + "': " + error.what());
  }
}

}  // namespace

TrueBuilding readBuilding(const std::string& path) {
  TrueBuilding building;
  readJsonFile(path, "building",
               [&](const JsonPlace& document) { building = buildingFrom(document); });
  return building;
}

void readRoomBoxes(const std::string& path, TrueBuilding* building) {
  building->rooms.clear();
  building->floors.clear();
  building->all_rooms_listed = false;
  readJsonFile(path, "rooms", [&](const JsonPlace& list) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      const TrueRoom& room = building->rooms.emplace_back(boxFrom(list[k], k));
      addFloorAt(room.extent.outline.front().z(), &building->floors);
    }
  });
}

}  // namespace mrpt_sgraphs
