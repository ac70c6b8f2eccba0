// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_markers.h"
#include "marker_layer.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr double kSphere_m = 1.6;
constexpr double kRoomEdge_m = 0.06;
constexpr double kConnection_m = 0.12;
constexpr double kText_m = 1.1;
constexpr double kTextAbove_m = 1.6;

}  // namespace

void addFloorMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                     const std::string& map_frame, visualization_msgs::MarkerArray* markers) {
  const auto green = colour(0.2F, 0.6F, 0.3F);
  Marker nodes = layer("floors", Marker::SPHERE_LIST, kSphere_m, green, map_frame);
  Marker rooms = layer("floor_rooms", Marker::LINE_LIST, kRoomEdge_m,
                       colour(0.2F, 0.6F, 0.3F, 0.7F), map_frame);
  Marker stairs = layer("floor_connections", Marker::LINE_LIST, kConnection_m,
                        colour(0.8F, 0.5F, 0.1F), map_frame);
  for (const RoomNode& room : graph.rooms) {
    if (room.floor) addEdge(places, *room.floor, room.id, &rooms);
  }
  for (const FloorNode& floor : graph.floors) {
    nodes.points.push_back(tf2::toMsg(*places.find(floor.id)));
    for (const FloorConnection& connection : floor.connections) {
      const Eigen::Vector3d* const other = places.find(connection.to);
      if (other == nullptr) continue;
      const Eigen::Vector3d here = places.lifted(connection.here_map, Layer::kFloor);
      const Eigen::Vector3d there = places.lifted(connection.there_map, Layer::kFloor);
      addLine(*places.find(floor.id), here, &stairs);
      addLine(here, there, &stairs);
      addLine(there, *other, &stairs);
    }
  }
  for (const Marker& marker : {nodes, rooms, stairs}) markers->markers.push_back(marker);
  for (const FloorNode& floor : graph.floors) {
    const Eigen::Vector3d above = *places.find(floor.id) + kTextAbove_m * Eigen::Vector3d::UnitZ();
    markers->markers.push_back(
        nameplate("floor_names", floor.id, floor.name, kText_m, above, map_frame));
  }
}

}  // namespace mrpt_sgraphs
