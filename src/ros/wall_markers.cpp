// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wall_markers.h"

#include <tf2_eigen/tf2_eigen.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "marker_layer.h"
#include "mrpt_sgraphs/geometry/triangulation.h"
#include "mrpt_sgraphs/mapping/wall_colour.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr float kWallAlpha = 0.6F;
constexpr double kOutline_m = 0.03;
constexpr double kSight_m = 0.01;
constexpr double kText_m = 0.3;
constexpr double kFloorHalfEdge_m = 1.0;

std_msgs::ColorRGBA wallColour(WallId id, float alpha) {
  const Eigen::Vector3f rgb = colourOf(id);
  return colour(rgb[0], rgb[1], rgb[2], alpha);
}

void addPoint(const Eigen::Vector3d& point, const std_msgs::ColorRGBA& rgba, Marker* marker) {
  marker->points.push_back(tf2::toMsg(point));
  marker->colors.push_back(rgba);
}

/// rviz shows triangles from both sides and, with a colour at each corner, unlit: of one colour.
void addTriangles(const std::vector<Triangle3>& triangles, const std_msgs::ColorRGBA& rgba,
                  Marker* marker) {
  for (const Triangle3& triangle : triangles) {
    for (const Eigen::Vector3d& corner : triangle) addPoint(corner, rgba, marker);
  }
}

void addRing(const Outline3& ring, const std_msgs::ColorRGBA& rgba, Marker* lines) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    addPoint(ring[k], rgba, lines);
    addPoint(ring[(k + 1) % ring.size()], rgba, lines);
  }
}

/// Of the surface; of a wall of which no extent is known, its point next to the origin.
Eigen::Vector3d centroidOf(const std::vector<Triangle3>& triangles, const Plane& plane) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area_m2 = 0.0;
  for (const Triangle3& t : triangles) {
    const double triangle_m2 = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    sum += triangle_m2 * (t[0] + t[1] + t[2]) / 3.0;
    area_m2 += triangle_m2;
  }
  return area_m2 > 0.0 ? Eigen::Vector3d(sum / area_m2) : plane.distance * plane.normal;
}

Marker nameplate(WallId id, const Eigen::Vector3d& place_map, const std::string& map_frame) {
  Marker text =
      layer("wall_ids", Marker::TEXT_VIEW_FACING, kText_m, colour(0.1F, 0.1F, 0.1F), map_frame);
  text.id = static_cast<std::int32_t>(id.value);
  text.pose.position = tf2::toMsg(place_map);
  text.text = std::to_string(id.value);
  return text;
}

/// Keyframes to the middles of the walls that they see.
Marker sights(const GraphSnapshot& graph, const std::map<NodeId, Eigen::Vector3d>& walls,
              const std::string& map_frame) {
  Marker lines = layer("wall_observations", Marker::LINE_LIST, kSight_m,
                       colour(0.6F, 0.6F, 0.6F, 0.5F), map_frame);
  std::map<NodeId, Eigen::Vector3d> keyframes;
  for (const KeyframeNode& node : graph.keyframes) {
    keyframes[node.id] = node.T_map_base.translation();
  }
  for (const StoredFactor& stored : graph.factors) {
    const Factor& factor = *stored.factor;
    if (factor.nodeCount() != 2) continue;
    const auto keyframe = keyframes.find(factor.node(0));
    const auto wall = walls.find(factor.node(1));
    if (keyframe == keyframes.end() || wall == walls.end()) continue;
    lines.points.push_back(tf2::toMsg(keyframe->second));
    lines.points.push_back(tf2::toMsg(wall->second));
  }
  return lines;
}

}  // namespace

void addWallMarkers(const GraphSnapshot& graph, const std::string& map_frame,
                    visualization_msgs::MarkerArray* markers) {
  const auto own_colours = colour(1.0F, 1.0F, 1.0F, kWallAlpha);
  constexpr double kUnscaled = 1.0;
  Marker walls = layer("walls", Marker::TRIANGLE_LIST, kUnscaled, own_colours, map_frame);
  Marker outlines =
      layer("wall_outlines", Marker::LINE_LIST, kOutline_m, colour(1.0F, 1.0F, 1.0F), map_frame);
  std::map<NodeId, Eigen::Vector3d> centroids;
  for (const WallNode& wall : graph.walls) {
    const auto triangles = triangulated(wall.extent_map, wall.plane_map);
    addTriangles(triangles, wallColour(wall.id, kWallAlpha), &walls);
    const auto rgba = wallColour(wall.id, 1.0F);
    addRing(wall.extent_map.outline, rgba, &outlines);
    for (const Outline3& hole : wall.extent_map.holes) addRing(hole, rgba, &outlines);
    centroids[wall.id] = centroidOf(triangles, wall.plane_map);
  }
  markers->markers.push_back(walls);
  markers->markers.push_back(outlines);
  markers->markers.push_back(sights(graph, centroids, map_frame));
  for (const WallNode& wall : graph.walls) {
    markers->markers.push_back(nameplate(wall.id, centroids[wall.id], map_frame));
  }
}

void addFloorMarkers(const GraphSnapshot& graph, const std::string& map_frame,
                     visualization_msgs::MarkerArray* markers) {
  const auto rgba = colour(0.3F, 0.6F, 0.35F, 0.5F);
  constexpr double kUnscaled = 1.0;
  Marker squares = layer("floors", Marker::TRIANGLE_LIST, kUnscaled, rgba, map_frame);
  for (const FloorNode& floor : graph.floors) {
    const PlaneFrame frame(floor.ground_map, floor.centre_map);
    constexpr double h = kFloorHalfEdge_m;
    const FlatExtent square{{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, {}};
    addTriangles(triangulated(lifted(square, frame), floor.ground_map), rgba, &squares);
  }
  markers->markers.push_back(squares);
}

}  // namespace mrpt_sgraphs
