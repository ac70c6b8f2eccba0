// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/building_file.h"

#include <cerrno>
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

TrueBuilding buildingFrom(const JsonPlace& document) {
  TrueBuilding building;
  const JsonPlace walls = document["walls"];
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const TrueWall& wall = building.walls.emplace_back(wallFrom(walls[k], k));
    building.surfaces.emplace_back(wall.extent.outline, wall.extent.holes);
  }
  const JsonPlace rooms = document["rooms"];
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    const JsonPlace room = rooms[k];
    Outline3 outline = room["polygon"].outline();
    building.surfaces.emplace_back(outline, std::vector<Outline3>{});
    if (!room.has("height")) continue;
    for (Eigen::Vector3d& corner : outline) corner.z() += room["height"].number();
    building.surfaces.emplace_back(outline, std::vector<Outline3>{});
  }
  if (building.surfaces.empty()) throw std::runtime_error("it has no walls and no rooms");
  return building;
}

}  // namespace

TrueBuilding readBuilding(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));
  try {
    const Json json = Json::parse(file);
    return buildingFrom(JsonPlace(json, "building"));
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read '" + path + "': " + error.what());
  }
}

}  // namespace mrpt_sgraphs
