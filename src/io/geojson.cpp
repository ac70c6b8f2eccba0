// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/geojson.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/semantics/doors.h"
#include "mrpt_sgraphs/semantics/places.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::ordered_json;

/// To the tenth of a millimetre: what is finer says nothing, and costs most of the file.
double rounded(double value_m) {
  constexpr double kSteps_per_m = 1e4;
  return std::round(value_m * kSteps_per_m) / kSteps_per_m + 0.0;  // no -0
}

Json position(const Eigen::Vector3d& p_map) {
  return {rounded(p_map.x()), rounded(p_map.y()), rounded(p_map.z())};
}

Json line(const std::vector<Eigen::Vector3d>& points_map) {
  Json coordinates = Json::array();
  for (const Eigen::Vector3d& point : points_map) coordinates.push_back(position(point));
  return {{"type", "LineString"}, {"coordinates", coordinates}};
}

/// Closed, and as RFC 7946 wants it: around an area counter-clockwise, around a hole clockwise.
Json ring(Outline3 corners_map, bool counter_clockwise) {
  const PlaneFrame from_above(Plane{}, Eigen::Vector3d::Zero());
  const bool is_counter_clockwise =
      signedArea(flattened({corners_map, {}}, from_above).outline) > 0.0;
  if (is_counter_clockwise != counter_clockwise) {
    std::reverse(corners_map.begin(), corners_map.end());
  }
  Json coordinates = Json::array();
  for (const Eigen::Vector3d& corner : corners_map) coordinates.push_back(position(corner));
  coordinates.push_back(position(corners_map.front()));
  return coordinates;
}

/// Null where the outline is not known: a feature may have no geometry.
Json polygon(const PlanarExtent& extent_map) {
  if (extent_map.outline.size() < 3) return nullptr;
  Json rings = Json::array({ring(extent_map.outline, true)});
  for (const Outline3& hole : extent_map.holes) {
    if (hole.size() >= 3) rings.push_back(ring(hole, false));
  }
  return {{"type", "Polygon"}, {"coordinates", rings}};
}

template <typename AnyId>
Json idOrNull(const std::optional<AnyId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}

Json feature(const std::string& id, Json geometry, Json properties) {
  return {{"type", "Feature"},
          {"id", id},
          {"geometry", std::move(geometry)},
          {"properties", std::move(properties)}};
}

Json floorName(const GraphSnapshot& graph, const std::optional<FloorId>& id) {
  const FloorNode* const floor = id ? findFloor(graph, *id) : nullptr;
  return floor != nullptr ? Json(floor->name) : Json(nullptr);
}

Json roomFeature(const GraphSnapshot& graph, const RoomNode& room) {
  return feature("room " + std::to_string(room.id.value), polygon(room.extent_map),
                 {{"kind", "room"},
                  {"room", room.id.value},
                  {"name", room.name},
                  {"room_kind", nameOf(room.kind)},
                  {"floor", idOrNull(room.floor)},
                  {"floor_name", floorName(graph, room.floor)},
                  {"area_m2", rounded(areaOf(room))},
                  {"height_m", rounded(room.height_m)},
                  {"centre", position(room.T_map_room.translation())}});
}

/// A door, or the way through it from the centre of one room to that of the other.
Json doorProperties(const GraphSnapshot& graph, const Door& door, const char* kind) {
  const RoomNode& from = *findRoom(graph, door.from);
  const RoomNode* const to = door.to ? findRoom(graph, *door.to) : nullptr;
  return {{"kind", kind},
          {"rooms", {door.from.value, idOrNull(door.to)}},
          {"names", {from.name, to != nullptr ? Json(to->name) : Json(nullptr)}},
          {"floor", idOrNull(from.floor)},
          {"floor_name", floorName(graph, from.floor)},
          {"width_m", rounded(door.width_m)},
          {"centre", position(door.centre_map)}};
}

Json wayFeature(const GraphSnapshot& graph, const Door& door, const RoomNode& to,
                const std::string& number) {
  const Eigen::Vector3d begin = findRoom(graph, door.from)->T_map_room.translation();
  const Eigen::Vector3d end = to.T_map_room.translation();
  Json properties = doorProperties(graph, door, "way");
  properties["length_m"] =
      rounded((door.centre_map - begin).norm() + (end - door.centre_map).norm());
  return feature("way " + number, line({begin, door.centre_map, end}), properties);
}

Json stairsFeature(const GraphSnapshot& graph, const Stairs& stairs, const std::string& number) {
  return feature("stairs " + number, line({stairs.from_map, stairs.to_map}),
                 {{"kind", "stairs"},
                  {"floors", {stairs.from.value, stairs.to.value}},
                  {"floor_names", {floorName(graph, stairs.from), floorName(graph, stairs.to)}}});
}

}  // namespace

void writeGeoJson(const GraphSnapshot& graph, std::ostream& out) {
  Json features = Json::array();
  for (const RoomNode& room : graph.rooms) features.push_back(roomFeature(graph, room));
  const std::vector<Door> doors = doorsOf(graph);
  for (std::size_t k = 0; k < doors.size(); ++k) {
    const std::string number = std::to_string(k);
    features.push_back(feature("door " + number, line({doors[k].begin_map(), doors[k].end_map()}),
                               doorProperties(graph, doors[k], "door")));
    const RoomNode* const to = doors[k].to ? findRoom(graph, *doors[k].to) : nullptr;
    if (to != nullptr) features.push_back(wayFeature(graph, doors[k], *to, number));
  }
  const std::vector<Stairs> stairs = stairsOf(graph);
  for (std::size_t k = 0; k < stairs.size(); ++k) {
    features.push_back(stairsFeature(graph, stairs[k], std::to_string(k)));
  }
  const Json document{
      {"type", "FeatureCollection"},
      {"coordinates_of",
       "planar: x, y and z in metres of the map frame (REP-105), no longitude and latitude"},
      {"generator", "mrpt_sgraphs"},
      {"features", features}};
  // a name that is no UTF-8 must not cost the file
  out << document.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace mrpt_sgraphs
