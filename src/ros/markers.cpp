// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/markers.h"

#include <algorithm>
#include <iterator>

#include "graph_markers.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

/// rviz complains of lists without points.
bool isEmptyList(const Marker& marker) {
  return marker.type != Marker::TEXT_VIEW_FACING && marker.points.empty();
}

}  // namespace

visualization_msgs::MarkerArray toMarkers(const GraphSnapshot& graph, const GraphView& view,
                                          const OptimizationSummary* last_optimization) {
  const ShownPlaces places(graph, view.layer_lift_m);
  visualization_msgs::MarkerArray layers;
  addKeyframeMarkers(graph, places, view.map_frame, &layers);
  if (last_optimization != nullptr) {
    addOptimizationMarkers(graph, places, *last_optimization, view.map_frame, &layers);
  }
  addWallMarkers(graph, places, view.map_frame, &layers);
  addRoomMarkers(graph, places, view.map_frame, &layers);
  addFloorMarkers(graph, places, view.map_frame, &layers);

  visualization_msgs::MarkerArray markers;
  markers.markers.emplace_back();
  markers.markers.front().header.frame_id = view.map_frame;
  markers.markers.front().action = Marker::DELETEALL;  // walls go, and their ids with them
  std::remove_copy_if(layers.markers.begin(), layers.markers.end(),
                      std::back_inserter(markers.markers), isEmptyList);
  return markers;
}

}  // namespace mrpt_sgraphs
