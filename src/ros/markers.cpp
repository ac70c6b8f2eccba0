// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/markers.h"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "marker_layer.h"
#include "wall_markers.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr double kSphere_m = 0.2;
constexpr double kEdge_m = 0.03;
constexpr double kLoop_m = 0.05;

void addKeyframeMarkers(const GraphSnapshot& graph, const std::string& map_frame,
                        visualization_msgs::MarkerArray* markers) {
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
  for (const Marker& marker : {keyframes, odometry, loops}) markers->markers.push_back(marker);
}

/// rviz complains of lists without points.
bool isEmptyList(const Marker& marker) {
  return marker.type != Marker::TEXT_VIEW_FACING && marker.points.empty();
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph,
                                          const std::string& map_frame) {
  visualization_msgs::MarkerArray layers;
  addKeyframeMarkers(graph, map_frame, &layers);
  addWallMarkers(graph, map_frame, &layers);
  addFloorMarkers(graph, map_frame, &layers);

  visualization_msgs::MarkerArray markers;
  markers.markers.emplace_back();
  markers.markers.front().header.frame_id = map_frame;
  markers.markers.front().action = Marker::DELETEALL;  // walls go, and their ids with them
  std::remove_copy_if(layers.markers.begin(), layers.markers.end(),
                      std::back_inserter(markers.markers), isEmptyList);
  return markers;
}

}  // namespace mrpt_sgraphs
