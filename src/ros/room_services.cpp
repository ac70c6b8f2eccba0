// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "room_services.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/semantics/places.h"
#include "service_answer.h"

namespace mrpt_sgraphs {
namespace {

/// @throws std::runtime_error if the graph has none.
GraphSnapshotConstPtr graphWithRooms(const GraphSnapshotConstPtr& graph) {
  if (!graph || graph->rooms.empty()) throw std::runtime_error("there is no room yet");
  return graph;
}

std::string inQuotes(const std::string& name) { return "'" + name + "'"; }

/// @throws std::runtime_error if there is none, or more than one.
const RoomNode& theRoomNamed(const GraphSnapshot& graph, const std::string& name) {
  const std::vector<const RoomNode*> rooms = roomsNamed(graph, name);
  if (rooms.size() == 1) return *rooms.front();
  std::string text = rooms.empty() ? "no room has the name " + inQuotes(name) + "; there are"
                                   : "more than one room has the name " + inQuotes(name) + ":";
  const char* separator = " ";
  for (const RoomNode& room : graph.rooms) {
    if (!rooms.empty() && room.name != name) continue;
    text += separator + inQuotes(room.name) + " (id " + std::to_string(room.id.value) + ")";
    separator = ", ";
  }
  throw std::runtime_error(text);
}

std::string whyNone(const Place& place) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "this place";
  if (place.floor != nullptr) text << " on " << inQuotes(place.floor->name);
  text << " is in no room";
  if (place.nearest != nullptr) {
    text << "; the nearest is " << inQuotes(place.nearest->name) << ", " << place.distance_m
         << " m away";
  }
  return text.str();
}

void setFloor(const FloorNode* floor, GetRoom::Response* response) {
  response->floor = GraphKeyframe::NONE;
  if (floor == nullptr) return;
  response->floor = static_cast<std::int64_t>(floor->id.value);
  response->floor_name = floor->name;
}

}  // namespace

RoomServices::RoomServices(ros::NodeHandle& nh, GraphSlamThread& slam,
                           std::function<GraphSnapshotConstPtr()> graph)
    : slam_(slam),
      graph_(std::move(graph)),
      get_room_(nh.advertiseService("get_room", &RoomServices::getRoom, this)),
      name_room_(nh.advertiseService("name_room", &RoomServices::nameRoom, this)) {}

bool RoomServices::getRoom(GetRoom::Request& request, GetRoom::Response& response) {
  response.floor = GraphKeyframe::NONE;
  return answer(response, [&]() -> std::string {
    const GraphSnapshotConstPtr graph = graphWithRooms(graph_());
    const RoomNode* room = nullptr;
    if (!request.name.empty()) {
      room = &theRoomNamed(*graph, request.name);
      setFloor(room->floor ? findFloor(*graph, *room->floor) : nullptr, &response);
    } else {
      const Eigen::Vector3d place_map(request.position.x, request.position.y, request.position.z);
      if (!place_map.allFinite()) throw std::invalid_argument("the position is not finite");
      const Place place = placeOf(*graph, place_map);
      setFloor(place.floor, &response);
      if (place.room == nullptr) throw std::runtime_error(whyNone(place));
      room = place.room;
    }
    response.room = toMsg(*graph, *room);
    return {};
  });
}

bool RoomServices::nameRoom(NameRoom::Request& request, NameRoom::Response& response) {
  return answer(response, [&] {
    const GraphSnapshotConstPtr graph = graphWithRooms(graph_());
    const RoomId id =
        request.room.empty() ? RoomId{request.id} : theRoomNamed(*graph, request.room).id;
    const RoomNode* const room = findRoom(*graph, id);
    if (room == nullptr) throw std::runtime_error("no room has the id " + std::to_string(id.value));
    slam_.nameRoom(id, request.name).get();
    response.id = id.value;
    return inQuotes(room->name) + " (id " + std::to_string(id.value) + ") is named " +
           inQuotes(request.name) + " now";
  });
}

}  // namespace mrpt_sgraphs
