// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "far_thinning.h"
#include "graph_palette.h"
#include "mrpt_sgraphs/mapping/shown_places.h"
#include "shown_graph.h"

namespace mrpt_sgraphs {

/// What of a graph is shown, and how. Without a layer there is nothing that ends at its nodes.
struct SceneOptions {
  bool keyframes = true;
  bool dropped_keyframes = true;
  bool odometry = true;
  bool loop_closures = true;
  bool condensed_factors = true;
  bool representatives = false;  ///< From each dropped keyframe to the one that it moves with.
  bool walls = true;
  bool wall_sightings = true;
  bool wall_pairs = false;
  bool wall_backs = false;  ///< Show walls also from behind, where they were not seen from.
  bool rooms = true;
  bool room_walls = true;
  bool doorways = true;
  bool floors = true;
  bool floor_rooms = true;
  bool stairs = true;
  bool ground_sightings = false;
  bool node_labels = true;  ///< Of rooms and floors.
  bool wall_labels = false;
  bool keyframe_labels = false;  ///< Of the nearest ones.

  ColourBy colour_by = ColourBy::kRoom;
  double layer_lift_m = 10.0;
  float wall_alpha = 0.5F;
  float room_alpha = 0.4F;
  float label_height_m = 0.9F;  ///< Of a room; floors are larger, walls and keyframes smaller.
  double near_m = 30.0;         ///< What is farther from the eye is thinned; 0: nothing.
  int thin_above = 1000;        ///< Unless there are no more keyframes than this.
};

/// Spheres of one size.
struct PointSet {
  struct Point {
    Eigen::Vector3f at;
    Eigen::Vector3f rgb;
    NodeId node;  ///< That is picked by it.
  };

  float size_m = 0.0F;  ///< Diameter.
  std::vector<Point> points = {};
};

struct LineSet {
  struct Line {
    Eigen::Vector3f from;
    Eigen::Vector3f to;
    Eigen::Vector3f rgb;
  };

  float width_m = 0.0F;  ///< 0: one pixel.
  float alpha = 1.0F;
  std::vector<Line> lines = {};
};

struct AreaSet {
  struct Triangle {
    std::array<Eigen::Vector3f, 3> corners;
    Eigen::Vector3f rgb;
    NodeId node;  ///< That is picked by it.
  };

  float alpha = 1.0F;
  bool from_both_sides = false;  ///< Else only from where they are counter-clockwise.
  std::vector<Triangle> triangles = {};
};

struct Label {
  std::string text;
  Eigen::Vector3f at;  ///< The middle of its lower edge.
  float height_m = 0.0F;
};

/// Ready to be drawn, in `map`: every set is one object of the renderer, however many nodes are in
/// it. A kind of scene always has as many sets, in the same order.
struct GraphScene {
  std::vector<PointSet> points;
  std::vector<LineSet> lines;
  std::vector<AreaSet> areas;
  std::vector<Label> labels;
};

/// A graph, and how it is to be drawn.
struct GraphDrawing {
  GraphDrawing(ShownGraphConstPtr shown_graph, const SceneOptions& scene_options)
      : graph(std::move(shown_graph)),
        options(scene_options),
        palette(*graph, options.colour_by),
        places(graph->nodes, options.layer_lift_m) {}

  /// Whether what is far from the eye is left out: of keyframes that are close together all but
  /// one, what they see, and what fills walls and rooms.
  bool isThinned() const {
    return options.near_m > 0.0 &&
           graph->nodes.keyframes.size() > static_cast<std::size_t>(options.thin_above);
  }
  bool isFar(const Eigen::Vector3d& place, const Eye& eye) const {
    return isThinned() && eye.distanceTo(place) > options.near_m;
  }

  ShownGraphConstPtr graph;
  SceneOptions options;
  GraphPalette palette;
  ShownPlaces places;
};

/// Walls, rooms, floors and what joins them.
GraphScene structureScene(const GraphDrawing& drawing, const Eye& eye);

}  // namespace mrpt_sgraphs
