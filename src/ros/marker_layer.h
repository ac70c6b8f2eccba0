// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_eigen/tf2_eigen.h>
#include <visualization_msgs/Marker.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/triangulation.h"
#include "mrpt_sgraphs/mapping/node_colour.h"
#include "mrpt_sgraphs/mapping/shown_places.h"

namespace mrpt_sgraphs {

inline std_msgs::ColorRGBA colour(float r, float g, float b, float alpha = 1.0F) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = alpha;
  return rgba;
}

inline std_msgs::ColorRGBA ownColour(NodeId node, float alpha = 1.0F) {
  const Eigen::Vector3f rgb = colourOf(node);
  return colour(rgb[0], rgb[1], rgb[2], alpha);
}

constexpr double kUnscaled = 1.0;  ///< For triangles, which have no size of their own.

/// A marker in `map`, stamped zero, which to tf means now: the graph is shown where it is, not
/// where it was.
/// @param name    Of its namespace.
/// @param size_m  Diameter of its spheres, edge of its cubes, width of its lines or height of its
///                text.
inline visualization_msgs::Marker layer(const std::string& name, int type, double size_m,
                                        const std_msgs::ColorRGBA& rgba,
                                        const std::string& map_frame) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = map_frame;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = size_m;
  marker.color = rgba;
  return marker;
}

/// The name of a node, to be read where it says.
/// @param text  Empty: the layer and the number.
inline visualization_msgs::Marker nameplate(const std::string& name_space, NodeId node,
                                            const std::string& text, double size_m,
                                            const Eigen::Vector3d& place_map,
                                            const std::string& map_frame) {
  visualization_msgs::Marker plate = layer(name_space, visualization_msgs::Marker::TEXT_VIEW_FACING,
                                           size_m, colour(0.1F, 0.1F, 0.1F), map_frame);
  plate.id = static_cast<std::int32_t>(node.value);
  plate.pose.position = tf2::toMsg(place_map);
  plate.text = text.empty() ? nameOf(node) : text;
  return plate;
}

inline void addPoint(const Eigen::Vector3d& point_map, const std_msgs::ColorRGBA& rgba,
                     visualization_msgs::Marker* marker) {
  marker->points.push_back(tf2::toMsg(point_map));
  marker->colors.push_back(rgba);
}

/// In the marker's one colour.
inline void addLine(const Eigen::Vector3d& from_map, const Eigen::Vector3d& to_map,
                    visualization_msgs::Marker* lines) {
  lines->points.push_back(tf2::toMsg(from_map));
  lines->points.push_back(tf2::toMsg(to_map));
}

/// Nothing if one of them is not in the graph.
inline void addEdge(const ShownPlaces& places, NodeId from, NodeId to,
                    visualization_msgs::Marker* lines) {
  const Eigen::Vector3d* const start = places.find(from);
  const Eigen::Vector3d* const end = places.find(to);
  if (start != nullptr && end != nullptr) addLine(*start, *end, lines);
}

/// An extent of a layer as triangles. rviz shows them from both sides and, with a colour at each
/// corner, unlit: of one colour.
inline void addArea(const PlanarExtent& extent_map, const Plane& plane_map, Layer layer,
                    const ShownPlaces& places, const std_msgs::ColorRGBA& rgba,
                    visualization_msgs::Marker* triangles) {
  for (const Triangle3& triangle : triangulated(extent_map, plane_map)) {
    for (const Eigen::Vector3d& corner : triangle) {
      addPoint(places.lifted(corner, layer), rgba, triangles);
    }
  }
}

/// The rings of an extent of a layer as lines.
inline void addRings(const PlanarExtent& extent_map, Layer layer, const ShownPlaces& places,
                     const std_msgs::ColorRGBA& rgba, visualization_msgs::Marker* lines) {
  const auto addRing = [&](const Outline3& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      addPoint(places.lifted(ring[k], layer), rgba, lines);
      addPoint(places.lifted(ring[(k + 1) % ring.size()], layer), rgba, lines);
    }
  };
  addRing(extent_map.outline);
  for (const Outline3& hole : extent_map.holes) addRing(hole);
}

}  // namespace mrpt_sgraphs
