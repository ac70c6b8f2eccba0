// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/graph_reader.h"

#include <stdexcept>

#include "factor_json.h"
#include "mrpt_sgraphs/graph/room_kind.h"

namespace mrpt_sgraphs {
namespace {

/// What the graph refuses, with the place in the file.
template <typename Action>
void at(const JsonPlace& place, const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    place.fail(std::string("is refused: ") + error.what());
  }
}

template <typename AnyId>
std::optional<AnyId> idOrNull(const JsonPlace& place) {
  if (place.isNull()) return std::nullopt;
  return AnyId{place.id()};
}

RoomAttributes::Kind kindOf(const JsonPlace& place) {
  const auto kind = roomKind(place.string());
  if (!kind) place.fail("is none of four_walls, corridor, polygon");
  return *kind;
}

void addKeyframe(const JsonPlace& place, LayeredGraph* graph) {
  const KeyframeId id{place["id"].id()};
  KeyframeAttributes attributes;
  attributes.stamp_s = place["stamp"].number();
  attributes.T_odom_base = place["odometry"].pose();
  attributes.floor = idOrNull<FloorId>(place["floor"]);
  attributes.room = idOrNull<RoomId>(place["room"]);
  attributes.marginalized = place["marginalized"].boolean();
  const KeyframeId representative{place["representative"].id()};
  if (representative != id) attributes.representative = representative;
  graph->restoreKeyframe(id, place["pose"].pose(), attributes);
}

void addWall(const JsonPlace& place, LayeredGraph* graph) {
  WallAttributes attributes;
  attributes.extent_map = place.extent();
  if (place.has("floor")) attributes.floor = idOrNull<FloorId>(place["floor"]);
  graph->restoreWall(WallId{place["id"].id()}, place["plane"].plane(), attributes);
}

Doorway doorwayAt(const JsonPlace& place) {
  Doorway doorway;
  doorway.to = idOrNull<RoomId>(place["to"]);
  doorway.centre_map = place["centre"].vector(3);
  doorway.width_m = place["width"].number();
  return doorway;
}

FloorConnection connectionAt(const JsonPlace& place) {
  FloorConnection connection;
  connection.to = FloorId{place["to"].id()};
  connection.here_map = place["here"].vector(3);
  connection.there_map = place["there"].vector(3);
  return connection;
}

void addRoom(const JsonPlace& place, LayeredGraph* graph) {
  RoomAttributes attributes;
  attributes.kind = kindOf(place["kind"]);
  const JsonPlace walls = place["walls"];
  for (std::size_t k = 0; k < walls.size(); ++k) attributes.walls.push_back({walls[k].id()});
  attributes.floor = idOrNull<FloorId>(place["floor"]);
  attributes.size_m = place["size"].vector(2);
  attributes.name = place["name"].string();
  attributes.extent_map = place.extent();
  if (place.has("height")) attributes.height_m = place["height"].number();
  if (place.has("doorways")) {
    const JsonPlace doorways = place["doorways"];
    for (std::size_t k = 0; k < doorways.size(); ++k) {
      attributes.doorways.push_back(doorwayAt(doorways[k]));
    }
  }
  graph->restoreRoom(RoomId{place["id"].id()}, place["pose"].pose(), attributes);
}

void addFloor(const JsonPlace& place, LayeredGraph* graph) {
  FloorAttributes attributes;
  attributes.centre_map = place["centre"].vector(3);
  attributes.name = place["name"].string();
  if (place.has("connections")) {
    const JsonPlace connections = place["connections"];
    for (std::size_t k = 0; k < connections.size(); ++k) {
      attributes.connections.push_back(connectionAt(connections[k]));
    }
  }
  graph->restoreFloor(FloorId{place["id"].id()}, place["plane"].plane(), attributes);
}

void requireNode(const LayeredGraph& graph, NodeId node, const JsonPlace& place) {
  if (!graph.contains(node)) place.fail("refers to " + nameOf(node) + ", which is not in the file");
}

/// What nodes say of each other, when all are there.
void requireReferences(const LayeredGraph& graph, const JsonPlace& document) {
  const JsonPlace keyframes = document["keyframes"];
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const KeyframeAttributes& keyframe = graph.attributes(KeyframeId{keyframes[k]["id"].id()});
    if (keyframe.floor) requireNode(graph, *keyframe.floor, keyframes[k]);
    if (keyframe.room) requireNode(graph, *keyframe.room, keyframes[k]);
    if (keyframe.representative) requireNode(graph, *keyframe.representative, keyframes[k]);
  }
  const JsonPlace walls = document["walls"];
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const WallAttributes& wall = graph.attributes(WallId{walls[k]["id"].id()});
    if (wall.floor) requireNode(graph, *wall.floor, walls[k]);
  }
  const JsonPlace floors = document["floors"];
  for (std::size_t k = 0; k < floors.size(); ++k) {
    const FloorAttributes& floor = graph.attributes(FloorId{floors[k]["id"].id()});
    for (const FloorConnection& way : floor.connections) requireNode(graph, way.to, floors[k]);
  }
  const JsonPlace rooms = document["rooms"];
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    const RoomAttributes& room = graph.attributes(RoomId{rooms[k]["id"].id()});
    if (room.floor) requireNode(graph, *room.floor, rooms[k]);
    for (const WallId wall : room.walls) requireNode(graph, wall, rooms[k]);
    for (const Doorway& doorway : room.doorways) {
      if (doorway.to) requireNode(graph, *doorway.to, rooms[k]);
    }
  }
}

/// A factor that another one stands for; the condensed factor of the kept keyframe is among those
/// of the graph.
void addShelved(const JsonPlace& place, LayeredGraph* graph) {
  const auto kept = idOrNull<KeyframeId>(place["kept"]);
  if (kept) requireNode(*graph, *kept, place);
  graph->shelve(graph->addFactor(factorFrom(place)), kept);
}

template <typename Add>
void addAll(const JsonPlace& list, const Add& add) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const JsonPlace place = list[k];
    at(place, [&] { add(place); });
  }
}

Json parsed(std::istream& in, const std::string& name) {
  try {
    return Json::parse(in);
  } catch (const Json::exception& error) {
    throw std::runtime_error(name + ": is no JSON: " + error.what());
  }
}

}  // namespace

LayeredGraph readGraphJson(std::istream& in, const std::string& name) {
  const Json json = parsed(in, name);
  const JsonPlace document(json, name.c_str());
  if (document["format"].string() != "mrpt_sgraphs/graph") {
    document["format"].fail("is not mrpt_sgraphs/graph");
  }
  const uint64_t version = document["version"].id();
  if (version != 1 && version != 2) {
    document["version"].fail("is " + std::to_string(version) + ": only 1 and 2 can be read");
  }

  LayeredGraph graph;
  graph.setMapOdom(document["map_odom"].pose());
  addAll(document["floors"], [&](const JsonPlace& place) { addFloor(place, &graph); });
  addAll(document["walls"], [&](const JsonPlace& place) { addWall(place, &graph); });
  addAll(document["rooms"], [&](const JsonPlace& place) { addRoom(place, &graph); });
  addAll(document["keyframes"], [&](const JsonPlace& place) { addKeyframe(place, &graph); });
  requireReferences(graph, document);
  addAll(document["factors"], [&](const JsonPlace& place) { graph.addFactor(factorFrom(place)); });
  if (document.has("shelved")) {
    addAll(document["shelved"], [&](const JsonPlace& place) { addShelved(place, &graph); });
    // these factors are no news to the condensed ones of the file, which were made of them
    const std::set<KeyframeId> read = graph.brokenShelves();
    for (const KeyframeId kept : read) graph.setMended(kept);
  }
  return graph;
}

}  // namespace mrpt_sgraphs
