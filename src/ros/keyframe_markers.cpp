// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_markers.h"
#include "marker_layer.h"
#include "mrpt_sgraphs/factors/condensed.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

constexpr double kSphere_m = 0.25;
constexpr double kDroppedSphere_m = 0.15;
constexpr double kEdge_m = 0.04;
constexpr double kLoop_m = 0.05;
constexpr double kCondensed_m = 0.04;
constexpr double kCondensedSight_m = 0.02;
constexpr double kBoxLine_m = 0.025;
constexpr double kBoxHalfEdge_m = 0.25;

/// The twelve edges of a cube.
void addBox(const Eigen::Vector3d& centre_map, Marker* lines) {
  const auto corner = [&centre_map](int number) -> Eigen::Vector3d {
    const auto side = [number](int axis) { return (number >> axis) % 2 == 0 ? -1.0 : 1.0; };
    return centre_map + kBoxHalfEdge_m * Eigen::Vector3d(side(0), side(1), side(2));
  };
  for (int number = 0; number < 8; ++number) {
    for (int axis = 0; axis < 3; ++axis) {
      const int neighbour = number | (1 << axis);
      if (neighbour != number) addLine(corner(number), corner(neighbour), lines);
    }
  }
}

/// From the kept keyframe of each condensed factor to the others, which nothing else ties to it.
void addCondensedMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                         const std::string& map_frame, visualization_msgs::MarkerArray* markers) {
  Marker keyframes =
      layer("condensed", Marker::LINE_LIST, kCondensed_m, colour(0.5F, 0.2F, 0.75F), map_frame);
  Marker walls = layer("condensed_observations", Marker::LINE_LIST, kCondensedSight_m,
                       colour(0.5F, 0.2F, 0.75F, 0.3F), map_frame);
  for (const StoredFactor& stored : graph.factors) {
    const auto* const factor = dynamic_cast<const CondensedFactor*>(stored.factor.get());
    if (factor == nullptr) continue;
    for (const CondensedFactor::Other& other : factor->others()) {
      if (other.node.layer == Layer::kFloor) continue;  // all see the ground: too many lines
      addEdge(places, factor->kept(), other.node,
              other.node.layer == Layer::kKeyframe ? &keyframes : &walls);
    }
  }
  markers->markers.push_back(keyframes);
  markers->markers.push_back(walls);
}

}  // namespace

void addKeyframeMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                        const std::string& map_frame, visualization_msgs::MarkerArray* markers) {
  Marker keyframes = layer("keyframes", Marker::SPHERE_LIST, kSphere_m, colour(0, 0, 0), map_frame);
  Marker marginalized = layer("marginalized_keyframes", Marker::SPHERE_LIST, kDroppedSphere_m,
                              colour(0.9F, 0.1F, 0.1F), map_frame);
  Marker odometry =
      layer("odometry", Marker::LINE_LIST, kEdge_m, colour(0.4F, 0.4F, 0.4F), map_frame);
  Marker loops =
      layer("loop_closures", Marker::LINE_LIST, kLoop_m, colour(0.9F, 0.1F, 0.1F), map_frame);
  for (const KeyframeNode& node : graph.keyframes) {
    (node.marginalized ? marginalized : keyframes)
        .points.push_back(tf2::toMsg(*places.find(node.id)));
  }
  for (const StoredFactor& stored : graph.factors) {
    const RelativePoseFactor* const edge = keyframeEdge(*stored.factor);
    if (edge == nullptr) continue;
    const bool is_loop = edge->kind == RelativePoseFactor::Kind::kLoopClosure;
    addEdge(places, edge->node(0), edge->node(1), is_loop ? &loops : &odometry);
  }
  for (const Marker& marker : {keyframes, marginalized, odometry, loops}) {
    markers->markers.push_back(marker);
  }
  addCondensedMarkers(graph, places, map_frame, markers);
}

void addOptimizationMarkers(const GraphSnapshot& graph, const ShownPlaces& places,
                            const OptimizationSummary& optimization, const std::string& map_frame,
                            visualization_msgs::MarkerArray* markers) {
  Marker free =
      layer("free_keyframes", Marker::LINE_LIST, kBoxLine_m, colour(0.1F, 0.6F, 0.2F), map_frame);
  Marker fixed =
      layer("fixed_keyframes", Marker::LINE_LIST, kBoxLine_m, colour(0.1F, 0.3F, 0.9F), map_frame);
  for (const KeyframeNode& node : graph.keyframes) {
    if (optimization.free_keyframes.contains(node.id)) addBox(*places.find(node.id), &free);
    if (optimization.fixed_keyframes.contains(node.id)) addBox(*places.find(node.id), &fixed);
  }
  markers->markers.push_back(free);
  markers->markers.push_back(fixed);
}

}  // namespace mrpt_sgraphs
