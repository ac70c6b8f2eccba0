// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstddef>

#include "graph_scene.h"
#include "mrpt_sgraphs/geometry/triangulation.h"

namespace mrpt_sgraphs {
namespace {

constexpr float kWallNode_m = 0.2F;
constexpr float kRoomNode_m = 1.0F;
constexpr float kRoomOutline_m = 0.06F;
constexpr float kRoomEdge_m = 0.04F;
constexpr float kDoorway_m = 0.35F;
constexpr float kWay_m = 0.08F;
constexpr float kFloorNode_m = 1.6F;
constexpr float kFloorEdge_m = 0.08F;
constexpr float kStairs_m = 0.12F;
constexpr float kPairEdge_m = 0.03F;
constexpr double kAboveNode_m = 1.0;

/// The sets of the scene, by what is in them.
struct Sets {
  PointSet doorways{kDoorway_m};
  PointSet floors{kFloorNode_m};
  AreaSet boxes;  ///< The nodes of walls and rooms.
  AreaSet walls;
  AreaSet grounds;
  LineSet wall_outlines;
  LineSet wall_pairs{kPairEdge_m};
  LineSet room_outlines{kRoomOutline_m};
  LineSet room_walls{kRoomEdge_m, 0.7F};
  LineSet ways{kWay_m};
  LineSet floor_rooms{kFloorEdge_m, 0.7F};
  LineSet stairs{kStairs_m};
};

constexpr float kShadeOfSide[] = {0.75F, 0.88F, 1.0F};  ///< By the axis that it looks along.

const Eigen::Vector3f kDark(0.25F, 0.25F, 0.25F);
const Eigen::Vector3f kStairsColour(0.8F, 0.5F, 0.1F);

class StructureScene {
 public:
  StructureScene(const GraphDrawing& drawing, const Eye& eye) : drawing_(drawing), eye_(eye) {
    sets_.walls.alpha = drawing.options.wall_alpha;
    sets_.walls.from_both_sides = drawing.options.wall_backs;
    sets_.grounds.alpha = drawing.options.room_alpha;
    if (drawing.options.walls) addWalls();
    if (drawing.options.rooms) addRooms();
    if (drawing.options.floors) addFloors();
  }

  GraphScene scene() const {
    return {{sets_.doorways, sets_.floors},
            {sets_.wall_outlines, sets_.wall_pairs, sets_.room_outlines, sets_.room_walls,
             sets_.ways, sets_.floor_rooms, sets_.stairs},
            {sets_.walls, sets_.grounds, sets_.boxes},
            labels_};
  }

 private:
  const GraphSnapshot& nodes() const { return drawing_.graph->nodes; }
  Eigen::Vector3d placeOf(NodeId node) const { return *drawing_.places.find(node); }

  void addPoint(NodeId node, PointSet* points) const {
    points->points.push_back({placeOf(node).cast<float>(), drawing_.palette.of(node), node});
  }

  /// Its sides are darker the less they face the sky, as if it were lit. rviz's own boxes take the
  /// software renderer several times as long.
  void addBox(NodeId node, float edge_m) {
    const Eigen::Vector3f centre = placeOf(node).cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      for (const float sign : {-1.0F, 1.0F}) {
        const Eigen::Vector3f out = 0.5F * edge_m * sign * Eigen::Vector3f::Unit(axis);
        const Eigen::Vector3f side = 0.5F * edge_m * Eigen::Vector3f::Unit((axis + 1) % 3);
        const Eigen::Vector3f up = sign * 0.5F * edge_m * Eigen::Vector3f::Unit((axis + 2) % 3);
        const Eigen::Vector3f rgb = kShadeOfSide[axis] * drawing_.palette.of(node);
        const Eigen::Vector3f face = centre + out;
        const std::array<Eigen::Vector3f, 4> corners{face - side - up, face + side - up,
                                                     face + side + up, face - side + up};
        sets_.boxes.triangles.push_back({{corners[0], corners[1], corners[2]}, rgb, node});
        sets_.boxes.triangles.push_back({{corners[0], corners[2], corners[3]}, rgb, node});
      }
    }
  }

  static void addLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                      const Eigen::Vector3f& rgb, LineSet* lines) {
    lines->lines.push_back({from.cast<float>(), to.cast<float>(), rgb});
  }

  /// Nothing if one of them is not in the graph.
  void addEdge(NodeId from, NodeId to, const Eigen::Vector3f& rgb, LineSet* lines) const {
    const Eigen::Vector3d* const start = drawing_.places.find(from);
    const Eigen::Vector3d* const end = drawing_.places.find(to);
    if (start != nullptr && end != nullptr) addLine(*start, *end, rgb, lines);
  }

  /// Nothing far away: its outline has to do, as what is filled costs most of the time.
  void addArea(NodeId node, const PlanarExtent& extent_map, const Plane& plane_map,
               AreaSet* area) const {
    if (drawing_.isFar(placeOf(node), eye_)) return;
    const auto shown = [&](const Eigen::Vector3d& corner_map) -> Eigen::Vector3f {
      return drawing_.places.lifted(corner_map, node.layer).cast<float>();
    };
    for (const Triangle3& triangle : triangulated(extent_map, plane_map)) {
      area->triangles.push_back({{shown(triangle[0]), shown(triangle[1]), shown(triangle[2])},
                                 drawing_.palette.of(node),
                                 node});
    }
  }

  void addRing(NodeId node, const Outline3& ring, LineSet* lines) const {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      addLine(drawing_.places.lifted(ring[k], node.layer),
              drawing_.places.lifted(ring[(k + 1) % ring.size()], node.layer),
              drawing_.palette.of(node), lines);
    }
  }

  void addOutlines(NodeId node, const PlanarExtent& extent_map, LineSet* lines) const {
    addRing(node, extent_map.outline, lines);
    for (const Outline3& hole : extent_map.holes) addRing(node, hole, lines);
  }

  /// @param size  Of the letters, in those of a room's label.
  void addLabel(NodeId node, const std::string& text, double above_m, float size) {
    const Eigen::Vector3d at = placeOf(node) + above_m * Eigen::Vector3d::UnitZ();
    labels_.push_back({text, at.cast<float>(), size * drawing_.options.label_height_m});
  }

  void addWalls() {
    for (const WallNode& wall : nodes().walls) {
      if (!drawing_.isFar(placeOf(wall.id), eye_)) addBox(wall.id, kWallNode_m);
      addArea(wall.id, wall.extent_map, wall.plane_map, &sets_.walls);
      addOutlines(wall.id, wall.extent_map, &sets_.wall_outlines);
      if (drawing_.options.wall_labels) {
        addLabel(wall.id, std::to_string(wall.id.value), kWallNode_m, 0.5F);
      }
    }
    if (!drawing_.options.wall_pairs) return;
    for (const Tie& tie : drawing_.graph->ties) {
      if (tie.kind == TieKind::kWallPair) addEdge(tie.from, tie.to, kDark, &sets_.wall_pairs);
    }
  }

  void addRooms() {
    for (const RoomNode& room : nodes().rooms) {
      addBox(room.id, kRoomNode_m);
      addArea(room.id, room.extent_map, groundOf(room), &sets_.grounds);
      addOutlines(room.id, room.extent_map, &sets_.room_outlines);
      if (drawing_.options.room_walls && drawing_.options.walls) {
        for (const WallId wall : room.walls) {
          addEdge(room.id, wall, drawing_.palette.of(room.id), &sets_.room_walls);
        }
      }
      if (drawing_.options.doorways) addDoorways(room);
      if (drawing_.options.node_labels) {
        addLabel(room.id, room.name.empty() ? nameOf(room.id) : room.name, kAboveNode_m, 1.0F);
      }
    }
  }

  /// To the doorways of each room; with those of the room on the other side, from room to room.
  void addDoorways(const RoomNode& room) {
    for (const Doorway& doorway : room.doorways) {
      const Eigen::Vector3d at = drawing_.places.lifted(doorway.centre_map, Layer::kRoom);
      sets_.doorways.points.push_back({at.cast<float>(), kDark, room.id});
      addLine(placeOf(room.id), at, kDark, &sets_.ways);
    }
  }

  void addFloors() {
    for (const FloorNode& floor : nodes().floors) {
      addPoint(floor.id, &sets_.floors);
      if (drawing_.options.stairs) addStairs(floor);
      if (drawing_.options.node_labels) {
        addLabel(floor.id, floor.name.empty() ? nameOf(floor.id) : floor.name, 1.5 * kAboveNode_m,
                 1.4F);
      }
    }
    if (!drawing_.options.rooms || !drawing_.options.floor_rooms) return;
    for (const RoomNode& room : nodes().rooms) {
      if (room.floor) {
        addEdge(*room.floor, room.id, drawing_.palette.of(*room.floor), &sets_.floor_rooms);
      }
    }
  }

  void addStairs(const FloorNode& floor) {
    for (const FloorConnection& connection : floor.connections) {
      const Eigen::Vector3d* const other = drawing_.places.find(connection.to);
      if (other == nullptr) continue;
      const Eigen::Vector3d here = drawing_.places.lifted(connection.here_map, Layer::kFloor);
      const Eigen::Vector3d there = drawing_.places.lifted(connection.there_map, Layer::kFloor);
      addLine(placeOf(floor.id), here, kStairsColour, &sets_.stairs);
      addLine(here, there, kStairsColour, &sets_.stairs);
      addLine(there, *other, kStairsColour, &sets_.stairs);
    }
  }

  const GraphDrawing& drawing_;
  const Eye eye_;
  Sets sets_;
  std::vector<Label> labels_;
};

}  // namespace

GraphScene structureScene(const GraphDrawing& drawing, const Eye& eye) {
  return StructureScene(drawing, eye).scene();
}

}  // namespace mrpt_sgraphs
