// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/markers.h"

#include <tf2_eigen/tf2_eigen.h>

#include <map>

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr double kSphere_m = 0.2;
constexpr double kEdge_m = 0.03;
constexpr double kLoop_m = 0.05;

std_msgs::ColorRGBA colour(float r, float g, float b) {
  std_msgs::ColorRGBA rgba;
  rgba.r = r;
  rgba.g = g;
  rgba.b = b;
  rgba.a = 1.0F;
  return rgba;
}

/// Stamped zero, which to tf means now: the graph is shown where it is, not where it was.
Marker layer(const std::string& name, int type, double size_m, const std_msgs::ColorRGBA& rgba,
             const std::string& map_frame) {
  Marker marker;
  marker.header.frame_id = map_frame;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = size_m;
  marker.color = rgba;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph,
                                          const std::string& map_frame) {
  Marker keyframes = layer("keyframes", Marker::SPHERE_LIST, kSphere_m, colour(0, 0, 0), map_frame);
  Marker odometry =
      layer("odometry", Marker::LINE_LIST, kEdge_m, colour(0.5F, 0.5F, 0.5F), map_frame);
  Marker loops =
      layer("loop_closures", Marker::LINE_LIST, kLoop_m, colour(0.9F, 0.1F, 0.1F), map_frame);

  std::map<KeyframeId, geometry_msgs::Point> places;
  for (const KeyframeNode& node : graph.keyframes) {
    places[node.id] = tf2::toMsg(Eigen::Vector3d(node.T_map_base.translation()));
    keyframes.points.push_back(places[node.id]);
  }
  for (const StoredFactor& stored : graph.factors) {
    const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
    if (edge == nullptr) continue;
    Marker& lines = edge->kind == RelativePoseFactor::Kind::kLoopClosure ? loops : odometry;
    lines.points.push_back(places.at(KeyframeId{edge->node(0).value}));
    lines.points.push_back(places.at(KeyframeId{edge->node(1).value}));
  }

  visualization_msgs::MarkerArray markers;
  for (Marker& marker : markers.markers = {keyframes, odometry, loops}) {
    if (marker.points.empty()) marker.action = Marker::DELETE;  // rviz complains of empty lists
  }
  return markers;
}

}  // namespace mrpt_sgraphs
