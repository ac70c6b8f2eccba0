// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <map>

#include "factor_json.h"
#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/io/exports.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kGraphVersion = 2;

template <typename AnyId>
Json idOrNull(const std::optional<AnyId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}

template <typename AnyId>
Json listOf(const std::vector<AnyId>& ids) {
  Json list = Json::array();
  for (const AnyId id : ids) list.push_back(id.value);
  return list;
}

Json polygon(const std::vector<Eigen::Vector3d>& corners_map) {
  Json list = Json::array();
  for (const Eigen::Vector3d& corner : corners_map) list.push_back(toJson(Eigen::VectorXd(corner)));
  return list;
}

Json holes(const PlanarExtent& extent) {
  Json list = Json::array();
  for (const Outline3& hole : extent.holes) list.push_back(polygon(hole));
  return list;
}

Json nodeJson(const KeyframeNode& keyframe) {
  return {{"id", keyframe.id.value},
          {"stamp", keyframe.stamp_s},
          {"pose", toJson(keyframe.T_map_base)},
          {"odometry", toJson(keyframe.T_odom_base)},
          {"floor", idOrNull(keyframe.floor)},
          {"room", idOrNull(keyframe.room)},
          {"marginalized", keyframe.marginalized},
          {"representative", keyframe.representative.value_or(keyframe.id).value}};
}

Json nodeJson(const WallNode& wall) {
  return {{"id", wall.id.value},
          {"plane", toJson(wall.plane_map)},
          {"polygon", polygon(wall.extent_map.outline)},
          {"holes", holes(wall.extent_map)},
          {"floor", idOrNull(wall.floor)}};
}

Json doorways(const RoomNode& room) {
  Json list = Json::array();
  for (const Doorway& doorway : room.doorways) {
    list.push_back({{"to", idOrNull(doorway.to)},
                    {"centre", toJson(Eigen::VectorXd(doorway.centre_map))},
                    {"width", doorway.width_m}});
  }
  return list;
}

Json nodeJson(const RoomNode& room, const std::vector<KeyframeId>& keyframes) {
  return {{"id", room.id.value},
          {"pose", toJson(room.T_map_room)},
          {"kind", nameOf(room.kind)},
          {"walls", listOf(room.walls)},
          {"floor", idOrNull(room.floor)},
          {"keyframes", listOf(keyframes)},
          {"size", toJson(Eigen::VectorXd(room.size_m))},
          {"name", room.name},
          {"polygon", polygon(room.extent_map.outline)},
          {"holes", holes(room.extent_map)},
          {"height", room.height_m},
          {"doorways", doorways(room)}};
}

Json connections(const FloorNode& floor) {
  Json list = Json::array();
  for (const FloorConnection& connection : floor.connections) {
    list.push_back({{"to", connection.to.value},
                    {"here", toJson(Eigen::VectorXd(connection.here_map))},
                    {"there", toJson(Eigen::VectorXd(connection.there_map))}});
  }
  return list;
}

/// What belongs to a floor or room, as those nodes say themselves.
struct Members {
  std::map<RoomId, std::vector<KeyframeId>> keyframes_in;
  std::map<FloorId, std::vector<KeyframeId>> keyframes_on;
  std::map<FloorId, std::vector<RoomId>> rooms_on;

  explicit Members(const GraphSnapshot& graph) {
    for (const KeyframeNode& keyframe : graph.keyframes) {
      if (keyframe.room) keyframes_in[*keyframe.room].push_back(keyframe.id);
      if (keyframe.floor) keyframes_on[*keyframe.floor].push_back(keyframe.id);
    }
    for (const RoomNode& room : graph.rooms) {
      if (room.floor) rooms_on[*room.floor].push_back(room.id);
    }
  }
};

Json nodeJson(const FloorNode& floor, const std::vector<RoomId>& rooms,
              const std::vector<KeyframeId>& keyframes) {
  return {{"id", floor.id.value},
          {"plane", toJson(floor.ground_map)},
          {"centre", toJson(Eigen::VectorXd(floor.centre_map))},
          {"name", floor.name},
          {"connections", connections(floor)},
          {"rooms", listOf(rooms)},
          {"keyframes", listOf(keyframes)}};
}

}  // namespace

void writeGraphJson(const GraphSnapshot& graph, std::ostream& out) {
  Members members(graph);
  Json document{{"format", "mrpt_sgraphs/graph"},
                {"version", kGraphVersion},
                {"map_odom", toJson(graph.T_map_odom)}};
  for (const char* list : {"keyframes", "walls", "rooms", "floors", "factors", "shelved"}) {
    document[list] = Json::array();
  }
  for (const KeyframeNode& keyframe : graph.keyframes) {
    document["keyframes"].push_back(nodeJson(keyframe));
  }
  for (const WallNode& wall : graph.walls) document["walls"].push_back(nodeJson(wall));
  for (const RoomNode& room : graph.rooms) {
    document["rooms"].push_back(nodeJson(room, members.keyframes_in[room.id]));
  }
  for (const FloorNode& floor : graph.floors) {
    document["floors"].push_back(
        nodeJson(floor, members.rooms_on[floor.id], members.keyframes_on[floor.id]));
  }
  for (const StoredFactor& stored : graph.factors) {
    document["factors"].push_back(toJson(*stored.factor));
  }
  for (const ShelvedFactor& shelved : graph.shelved) {
    document["shelved"].push_back(toJson(*shelved.factor));
    document["shelved"].back()["kept"] = idOrNull(shelved.kept);
  }
  // a name that is no UTF-8 must not cost the file
  out << document.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace mrpt_sgraphs
