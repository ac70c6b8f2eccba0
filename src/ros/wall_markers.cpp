// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_markers.h"
#include "marker_layer.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr float kWallAlpha = 0.6F;
constexpr double kOutline_m = 0.03;
constexpr double kSight_m = 0.02;
constexpr double kText_m = 0.3;

/// Keyframes to the walls that they see.
Marker sights(const GraphSnapshot& graph, const ShownPlaces& places, const std::string& map_frame) {
  Marker lines = layer("wall_observations", Marker::LINE_LIST, kSight_m,
                       colour(0.6F, 0.65F, 0.75F, 0.4F), map_frame);
  for (const StoredFactor& stored : graph.factors) {
    const Factor& factor = *stored.factor;
    const bool is_sight = factor.nodeCount() == 2 && factor.node(0).layer == Layer::kKeyframe &&
                          factor.node(1).layer == Layer::kWall;
    if (is_sight) addEdge(places, factor.node(0), factor.node(1), &lines);
  }
  return lines;
}

}  // namespace

void addWallMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                    const std::string& map_frame, visualization_msgs::MarkerArray* markers) {
  const auto own_colours = colour(1.0F, 1.0F, 1.0F, kWallAlpha);
  Marker walls = layer("walls", Marker::TRIANGLE_LIST, kUnscaled, own_colours, map_frame);
  Marker outlines =
      layer("wall_outlines", Marker::LINE_LIST, kOutline_m, colour(1.0F, 1.0F, 1.0F), map_frame);
  for (const WallNode& wall : graph.walls) {
    addArea(wall.extent_map, wall.plane_map, Layer::kWall, places, ownColour(wall.id, kWallAlpha),
            &walls);
    addRings(wall.extent_map, Layer::kWall, places, ownColour(wall.id), &outlines);
  }
  markers->markers.push_back(walls);
  markers->markers.push_back(outlines);
  markers->markers.push_back(sights(graph, places, map_frame));
  for (const WallNode& wall : graph.walls) {
    markers->markers.push_back(nameplate("wall_ids", wall.id, std::to_string(wall.id.value),
                                         kText_m, *places.find(wall.id), map_frame));
  }
}

}  // namespace mrpt_sgraphs
