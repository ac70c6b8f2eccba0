// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_markers.h"
#include "marker_layer.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr float kAreaAlpha = 0.45F;
constexpr double kOutline_m = 0.06;
constexpr double kCube_m = 1.0;
constexpr double kDoorway_m = 0.35;
constexpr double kWallEdge_m = 0.05;
constexpr double kDoorwayEdge_m = 0.08;
constexpr double kText_m = 0.9;
constexpr double kTextAbove_m = 1.3;

/// To the doorways of each room; with those of the room on the other side, from room to room.
void addDoorways(const RoomNode& room, const ShownPlaces& places, Marker* doorways, Marker* edges) {
  for (const Doorway& doorway : room.doorways) {
    const Eigen::Vector3d place = places.lifted(doorway.centre_map, Layer::kRoom);
    doorways->points.push_back(tf2::toMsg(place));
    addLine(*places.find(room.id), place, edges);
  }
}

}  // namespace

void addRoomMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                    const std::string& map_frame, visualization_msgs::MarkerArray* markers) {
  const auto own_colours = colour(1.0F, 1.0F, 1.0F, kAreaAlpha);
  const auto dark = colour(0.25F, 0.25F, 0.25F);
  Marker areas = layer("room_areas", Marker::TRIANGLE_LIST, kUnscaled, own_colours, map_frame);
  Marker outlines =
      layer("room_outlines", Marker::LINE_LIST, kOutline_m, colour(1.0F, 1.0F, 1.0F), map_frame);
  Marker nodes = layer("rooms", Marker::CUBE_LIST, kCube_m, colour(1.0F, 1.0F, 1.0F), map_frame);
  Marker walls =
      layer("room_walls", Marker::LINE_LIST, kWallEdge_m, colour(0.45F, 0.45F, 0.45F), map_frame);
  Marker doorways = layer("doorways", Marker::SPHERE_LIST, kDoorway_m, dark, map_frame);
  Marker ways = layer("room_doorways", Marker::LINE_LIST, kDoorwayEdge_m, dark, map_frame);
  for (const RoomNode& room : graph.rooms) {
    addArea(room.extent_map, groundOf(room), Layer::kRoom, places, ownColour(room.id, kAreaAlpha),
            &areas);
    addRings(room.extent_map, Layer::kRoom, places, ownColour(room.id), &outlines);
    addPoint(*places.find(room.id), ownColour(room.id), &nodes);
    for (const WallId wall : room.walls) addEdge(places, room.id, wall, &walls);
    addDoorways(room, places, &doorways, &ways);
  }
  for (const Marker& marker : {areas, outlines, nodes, walls, doorways, ways}) {
    markers->markers.push_back(marker);
  }
  for (const RoomNode& room : graph.rooms) {
    const Eigen::Vector3d above = *places.find(room.id) + kTextAbove_m * Eigen::Vector3d::UnitZ();
    markers->markers.push_back(
        nameplate("room_names", room.id, room.name, kText_m, above, map_frame));
  }
}

}  // namespace mrpt_sgraphs
