// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/truth.h"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/atomic_file.h"
#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

using Json = nlohmann::json;

constexpr double kSecondsPerNs = 1e-9;

Json toJson(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json toJson(const Polygon2& outline, double z_m) {
  Json polygon = Json::array();
  for (const Eigen::Vector2d& p : outline) polygon.push_back(toJson({p.x(), p.y(), z_m}));
  return polygon;
}

Json toJson(const Pose& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d p = T.translation();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Pose poseAtScan(const Simulation& simulation, int64_t index) {
  return simulation.trajectory().T_map_base(static_cast<double>(simulation.scanStart_ns(index)) *
                                            kSecondsPerNs);
}

std::string tum(const Simulation& simulation, const Pose& T_base_sensor) {
  constexpr int64_t kNsPerSecond = 1'000'000'000;
  std::string text;
  for (int64_t k = 0; k < simulation.scanCount(); ++k) {
    const int64_t start_ns = simulation.scanStart_ns(k);
    const Pose T = poseAtScan(simulation, k) * T_base_sensor;
    const Eigen::Vector3d p = T.translation();
    Eigen::Quaterniond q(T.linear());
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    char line[256];
    std::snprintf(line, sizeof line,
                  "%" PRId64 ".%09" PRId64 " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                  simulation.config().start_s + start_ns / kNsPerSecond, start_ns % kNsPerSecond, p.x(), p.y(),
                  p.z(), q.x(), q.y(), q.z(), q.w());
    text += line;
  }
  return text;
}

/// How many scans began in each room.
std::vector<int> scansInRooms(const Simulation& simulation) {
  const Building& building = simulation.building();
  const double base_height_m = simulation.config().robot.base_height_m;
  std::vector<int> counts(building.rooms.size(), 0);
  for (int64_t k = 0; k < simulation.scanCount(); ++k) {
    const Eigen::Vector3d p = poseAtScan(simulation, k).translation();
    size_t storey = 0;
    for (size_t s = 1; s < building.storeys.size(); ++s) {
      constexpr double kOnFloor_m = 0.2;  // a gait's bob is less, a step of stairs too
      if (p.z() - base_height_m > building.storeys[s].elevation_m - kOnFloor_m) storey = s;
    }
    const auto room = building.roomAt(storey, p.head<2>());
    if (room) ++counts[*room];
  }
  return counts;
}

Json floorsJson(const Building& building) {
  Json floors = Json::array();
  for (size_t k = 0; k < building.storeys.size(); ++k) {
    const Storey& storey = building.storeys[k];
    floors.push_back({{"id", k},
                      {"name", storey.name},
                      {"elevation", storey.elevation_m},
                      {"height", storey.height_m}});
  }
  return floors;
}

Json roomsJson(const Simulation& simulation) {
  const Building& building = simulation.building();
  const std::vector<int> scans = scansInRooms(simulation);
  Json rooms = Json::array();
  for (size_t k = 0; k < building.rooms.size(); ++k) {
    const Room& room = building.rooms[k];
    const Storey& storey = building.storeys[room.storey];
    rooms.push_back({{"id", k},
                     {"name", room.name},
                     {"kind", toString(room.kind)},
                     {"floor", room.storey},
                     {"polygon", toJson(room.outline, storey.elevation_m)},
                     {"height", storey.height_m},
                     {"entered", scans[k] > 0},
                     {"scans_inside", scans[k]}});
  }
  return rooms;
}

Json wallsJson(const Building& building, const SeenWalls& seen) {
  const auto rectangleJson = [](const WallFace& face, double begin_m, double end_m, double bottom_m,
                                double top_m) {
    return Json{toJson(face.at(begin_m, bottom_m)), toJson(face.at(end_m, bottom_m)),
                toJson(face.at(end_m, top_m)), toJson(face.at(begin_m, top_m))};
  };
  Json walls = Json::array();
  for (const WallFace& face : wallFaces(building)) {
    const Eigen::Vector2d normal = face.inward();
    Json holes = Json::array();
    for (const FaceOpening& hole : face.openings) {
      holes.push_back(rectangleJson(face, hole.begin_m, hole.end_m, hole.bottom_m, hole.top_m));
    }
    walls.push_back({{"id", walls.size()},
                     {"room", face.room},
                     {"floor", face.storey},
                     {"normal", toJson({normal.x(), normal.y(), 0.0})},
                     {"distance", normal.dot(face.first)},
                     {"polygon", rectangleJson(face, 0.0, face.length_m(), 0.0, face.height_m)},
                     {"holes", holes},
                     {"seen_m2", seen.area_m2(walls.size())}});
  }
  return walls;
}

Json doorsJson(const Building& building) {
  Json doors = Json::array();
  for (const Door& door : building.doors) {
    const Eigen::Vector2d centre =
        0.5 * (doorEdge(building, door, 0).middle() + doorEdge(building, door, 1).middle());
    const double floor_m = building.storeys[door.storey].elevation_m;
    doors.push_back({{"rooms", {door.faces[0].room, door.faces[1].room}},
                     {"floor", door.storey},
                     {"centre", toJson({centre.x(), centre.y(), floor_m + 0.5 * door.height_m})},
                     {"width", door.width_m}});
  }
  return doors;
}

/// A round footprint as a polygon.
Polygon2 roundOutline(const Eigen::Vector2d& centre, double radius_m) {
  constexpr int kCorners = 24;  // within 1 % of the radius
  Polygon2 outline;
  for (int k = 0; k < kCorners; ++k) {
    outline.push_back(centre + radius_m * direction(2.0 * M_PI * k / kCorners));
  }
  return outline;
}

/// What stands in the rooms, each from its footprint up. Of tables and scaffolds it is the space
/// that they stand in, and the platforms.
Json obstaclesJson(const Building& building) {
  Json obstacles = Json::array();
  const auto add = [&](size_t storey, const Polygon2& outline, double bottom_m, double height_m) {
    const double floor_m = building.storeys[storey].elevation_m;
    obstacles.push_back({{"floor", storey},
                         {"polygon", toJson(outline, floor_m + bottom_m)},
                         {"height", height_m}});
  };
  for (const Furniture& piece : building.furniture) {
    const Polygon2 outline =
        rectangle(piece.at, {piece.size_m[0], piece.size_m[1]}, piece.yaw_rad);
    add(piece.storey, outline, 0.0, piece.size_m[2]);
    if (piece.kind != FurnitureKind::kScaffold) continue;
    constexpr double kPlatform_m = 0.05;
    for (double top_m = 1.0; top_m < piece.size_m[2]; top_m += 1.0) {
      add(piece.storey, outline, top_m - kPlatform_m, kPlatform_m);
    }
  }
  for (const Pillar& pillar : building.pillars) {
    add(pillar.storey,
        pillar.radius_m ? roundOutline(pillar.at, *pillar.radius_m)
                        : rectangle(pillar.at, pillar.size_m, pillar.yaw_rad),
        0.0, building.storeys[pillar.storey].height_m);
  }
  return obstacles;
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  std::ofstream stream(file.part(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + path.string());
  file.commit();
}

}  // namespace

std::string lidarTrajectoryTum(const Simulation& simulation) {
  return tum(simulation, simulation.T_base_lidar());
}

std::string baseTrajectoryTum(const Simulation& simulation) {
  return tum(simulation, Pose::Identity());
}

std::string buildingJson(const Simulation& simulation) {
  const Building& building = simulation.building();
  const Json json{{"version", 1},
                  {"name", building.name},
                  {"rotation_deg", building.rotation_rad * 180.0 / M_PI},
                  {"T_base_lidar", toJson(simulation.T_base_lidar())},
                  {"floors", floorsJson(building)},
                  {"rooms", roomsJson(simulation)},
                  {"walls", wallsJson(building, simulation.seenWalls())},
                  {"doors", doorsJson(building)},
                  {"obstacles", obstaclesJson(building)}};
  constexpr int kIndent = 1;
  return json.dump(kIndent) + "\n";
}

void writeTruth(const Simulation& simulation, const std::string& directory) {
  const std::filesystem::path truth = std::filesystem::path(directory) / "truth";
  std::filesystem::create_directories(truth);
  writeText(truth / "trajectory.tum", lidarTrajectoryTum(simulation));
  writeText(truth / "base_trajectory.tum", baseTrajectoryTum(simulation));
  writeText(truth / "building.json", buildingJson(simulation));
}

}  // namespace mrpt_sgraphs::sim
