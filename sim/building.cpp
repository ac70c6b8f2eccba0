// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/building.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "sim/building_check.h"
#include "sim/yaml_map.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

/// Turns YAML into a Building, in the building's own frame.
class BuildingReader {
 public:
  explicit BuildingReader(const std::string& path)
      : path_(path), file_(std::filesystem::path(path).filename().string()) {}

  Building read() {
    const YamlMap top(parse(), file_, "building",
                      {"name", "rotation_deg", "storeys", "stairs", "tour"});
    building_.name = top.text("name");
    const double rotation_rad = top.number("rotation_deg", 0.0) * kRadPerDeg;
    for (const YAML::Node& node : top.list("storeys")) readStorey(node);
    if (building_.storeys.empty()) top.fail("field 'storeys' needs at least one storey");
    for (const YAML::Node& node : top.list("stairs")) readFlight(node);
    for (const YAML::Node& node : top.list("tour")) readTourStop(node);
    if (building_.tour.empty()) top.fail("field 'tour' needs at least one stop");
    return turned(std::move(building_), rotation_rad);
  }

 private:
  YAML::Node parse() const {
    try {
      return YAML::LoadFile(path_);
    } catch (const YAML::BadFile&) {
      throw std::invalid_argument(path_ + ": cannot be read");
    } catch (const YAML::ParserException& error) {
      throw std::invalid_argument(file_ + ":" + std::to_string(error.mark.line + 1) +
                                  ": not YAML: " + error.msg);
    }
  }

  static double heading(const YamlMap& map, const std::string& field) {
    return map.number(field, 0.0) * kRadPerDeg;
  }

  void readStorey(const YAML::Node& node) {
    const YamlMap map(node, file_, "storey",
                      {"name", "elevation_m", "height_m", "rooms", "doors", "windows", "furniture",
                       "pillars", "people"});
    storey_ = building_.storeys.size();
    building_.storeys.push_back(
        {map.text("name"), map.number("elevation_m", 0.0), map.positive("height_m"), map.where()});
    for (const YAML::Node& room : map.list("rooms")) readRoom(room);
    for (const YAML::Node& door : map.list("doors")) readDoor(door);
    for (const YAML::Node& window : map.list("windows")) readWindow(window);
    for (const YAML::Node& piece : map.list("furniture")) readFurniture(piece);
    for (const YAML::Node& pillar : map.list("pillars")) readPillar(pillar);
    for (const YAML::Node& person : map.list("people")) readPerson(person);
  }

  void readRoom(const YAML::Node& node) {
    const YamlMap map(node, file_, "room", {"name", "kind", "polygon", "rectangle"});
    Room room;
    room.name = map.text("name");
    room.where = map.where() + " '" + room.name + "'";
    room.storey = storey_;
    const std::string kind = map.has("kind") ? map.text("kind") : "room";
    if (kind == "corridor") {
      room.kind = RoomKind::kCorridor;
    } else if (kind == "stairwell") {
      room.kind = RoomKind::kStairwell;
    } else if (kind != "room") {
      map.fail("field 'kind' is '" + kind + "'; known are room, corridor, stairwell");
    }
    if (map.has("polygon") == map.has("rectangle")) {
      map.fail("needs either 'polygon' or 'rectangle'");
    }
    if (map.has("polygon")) {
      room.outline = map.points("polygon");
    } else {
      const std::vector<double> r = map.numbers("rectangle", 4);  // x_min, y_min, x_max, y_max
      if (r[2] <= r[0] || r[3] <= r[1]) {
        map.fail("field 'rectangle' is [x_min, y_min, x_max, y_max]");
      }
      room.outline = {{r[0], r[1]}, {r[2], r[1]}, {r[2], r[3]}, {r[0], r[3]}};
    }
    building_.rooms.push_back(std::move(room));
  }

  void readDoor(const YAML::Node& node) {
    const YamlMap map(node, file_, "door", {"at", "width_m", "height_m"});
    Door door;
    door.storey = storey_;
    door.at = map.point("at");
    door.width_m = map.positive("width_m", 1.0);
    door.height_m = map.positive("height_m", 2.1);
    door.where = map.where();
    building_.doors.push_back(door);
  }

  void readWindow(const YAML::Node& node) {
    const YamlMap map(node, file_, "window", {"at", "width_m", "sill_m", "height_m"});
    Window window;
    window.storey = storey_;
    window.at = map.point("at");
    window.width_m = map.positive("width_m");
    window.sill_m = map.positive("sill_m", 0.9);
    window.height_m = map.positive("height_m", 1.2);
    window.where = map.where();
    building_.windows.push_back(window);
  }

  void readFurniture(const YAML::Node& node) {
    const YamlMap map(node, file_, "furniture", {"kind", "at", "size_m", "yaw_deg"});
    Furniture piece;
    const std::string kind = map.has("kind") ? map.text("kind") : "box";
    if (kind == "table") {
      piece.kind = FurnitureKind::kTable;
    } else if (kind == "scaffold") {
      piece.kind = FurnitureKind::kScaffold;
    } else if (kind != "box" && kind != "shelf" && kind != "cabinet") {
      map.fail("field 'kind' is '" + kind + "'; known are box, shelf, cabinet, table, scaffold");
    }
    piece.storey = storey_;
    piece.at = map.point("at");
    piece.yaw_rad = heading(map, "yaw_deg");
    const std::vector<double> size = map.numbers("size_m", 3);
    for (size_t k = 0; k < 3; ++k) {
      if (size[k] <= 0.0) map.fail("field 'size_m' must be positive");
      piece.size_m[k] = size[k];
    }
    piece.where = map.where();
    building_.furniture.push_back(piece);
  }

  void readPillar(const YAML::Node& node) {
    const YamlMap map(node, file_, "pillar", {"at", "radius_m", "size_m", "yaw_deg"});
    Pillar pillar;
    pillar.storey = storey_;
    pillar.at = map.point("at");
    pillar.yaw_rad = heading(map, "yaw_deg");
    if (map.has("radius_m") == map.has("size_m")) map.fail("needs either 'radius_m' or 'size_m'");
    if (map.has("radius_m")) {
      pillar.radius_m = map.positive("radius_m");
    } else {
      pillar.size_m = map.point("size_m");
      if (pillar.size_m.minCoeff() <= 0.0) map.fail("field 'size_m' must be positive");
    }
    pillar.where = map.where();
    building_.pillars.push_back(pillar);
  }

  void readPerson(const YAML::Node& node) {
    const YamlMap map(node, file_, "person", {"from", "to", "speed_m_s"});
    building_.people.push_back(
        {storey_, map.point("from"), map.point("to"), map.positive("speed_m_s", 1.0), map.where()});
  }

  void readFlight(const YAML::Node& node) {
    const YamlMap map(node, file_, "stairs",
                      {"from", "to", "foot", "heading_deg", "width_m", "run_m", "steps"});
    Flight flight;
    flight.lower_storey = storeyNamed(map, "from");
    flight.upper_storey = storeyNamed(map, "to");
    flight.foot = map.point("foot");
    flight.heading_rad = heading(map, "heading_deg");
    flight.width_m = map.positive("width_m", 1.2);
    flight.run_m = map.positive("run_m");
    flight.steps = map.count("steps");
    flight.where = map.where();
    building_.flights.push_back(flight);
  }

  void readTourStop(const YAML::Node& node) {
    TourStop stop;
    if (node.IsScalar()) {
      stop.where = placeOf(node, file_, "tour");
      stop.room = roomNamed(stop.where, node.Scalar());
    } else {
      const YamlMap map(node, file_, "tour", {"room", "at", "pass_through"});
      stop.where = map.where();
      stop.room = roomNamed(stop.where, map.text("room"));
      stop.pass_through = map.flag("pass_through", false);
      if (map.has("at")) stop.points = map.points("at");
    }
    building_.tour.push_back(std::move(stop));
  }

  size_t storeyNamed(const YamlMap& map, const std::string& field) const {
    const std::string name = map.text(field);
    for (size_t k = 0; k < building_.storeys.size(); ++k) {
      if (building_.storeys[k].name == name) return k;
    }
    map.fail("field '" + field + "' names no storey: '" + name + "'");
  }

  size_t roomNamed(const std::string& where, const std::string& name) const {
    for (size_t k = 0; k < building_.rooms.size(); ++k) {
      if (building_.rooms[k].name == name) return k;
    }
    throw std::invalid_argument(where + ": there is no room '" + name + "'");
  }

  std::string path_;
  std::string file_;
  Building building_;
  size_t storey_ = 0;  ///< The one being read.
};

}  // namespace

const char* toString(RoomKind kind) {
  switch (kind) {
    case RoomKind::kCorridor:
      return "corridor";
    case RoomKind::kStairwell:
      return "stairwell";
    default:
      return "room";
  }
}

Building turned(Building building, double angle_rad) {
  const Eigen::Vector2d x = direction(angle_rad);
  const auto turn = [&x](Eigen::Vector2d& p) { p = (p.x() * x + p.y() * leftOf(x)).eval(); };
  building.rotation_rad += angle_rad;
  for (Room& room : building.rooms) std::for_each(room.outline.begin(), room.outline.end(), turn);
  for (Door& door : building.doors) turn(door.at);
  for (Window& window : building.windows) turn(window.at);
  for (Furniture& piece : building.furniture) {
    turn(piece.at);
    piece.yaw_rad += angle_rad;
  }
  for (Pillar& pillar : building.pillars) {
    turn(pillar.at);
    pillar.yaw_rad += angle_rad;
  }
  for (Person& person : building.people) {
    turn(person.from);
    turn(person.to);
  }
  for (Flight& flight : building.flights) {
    turn(flight.foot);
    flight.heading_rad += angle_rad;
  }
  for (TourStop& stop : building.tour) std::for_each(stop.points.begin(), stop.points.end(), turn);
  return building;
}

Building withTours(Building building, std::size_t tours) {
  const std::vector<TourStop> tour = std::move(building.tour);
  building.tour.clear();
  for (std::size_t k = 0; k < tours; ++k) {
    building.tour.insert(building.tour.end(), tour.begin(), tour.end());
  }
  return building;
}

Building loadBuilding(const std::string& file) {
  Building building = BuildingReader(file).read();
  checkRooms(building);
  resolveOpenings(building);
  checkContents(building);
  return building;
}

}  // namespace mrpt_sgraphs::sim
