// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_layer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "mrpt_sgraphs/semantics/room_factors.h"
#include "mrpt_sgraphs/semantics/room_matching.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSame_m = 0.005;  ///< What has moved by less is where it was.

bool isSame(const Outline3& a, const Outline3& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return (p - q).norm() < kSame_m; });
}

bool isSame(const Doorway& a, const Doorway& b) {
  return a.to == b.to && (a.centre_map - b.centre_map).norm() < kSame_m &&
         std::abs(a.width_m - b.width_m) < kSame_m;
}

bool isSame(const RoomAttributes& a, const RoomAttributes& b) {
  return a.kind == b.kind && a.walls == b.walls && a.floor == b.floor && a.name == b.name &&
         (a.size_m - b.size_m).norm() < kSame_m && std::abs(a.height_m - b.height_m) < kSame_m &&
         isSame(a.extent_map.outline, b.extent_map.outline) &&
         std::equal(a.extent_map.holes.begin(), a.extent_map.holes.end(),
                    b.extent_map.holes.begin(), b.extent_map.holes.end(),
                    [](const Outline3& p, const Outline3& q) { return isSame(p, q); }) &&
         std::equal(a.doorways.begin(), a.doorways.end(), b.doorways.begin(), b.doorways.end(),
                    [](const Doorway& p, const Doorway& q) { return isSame(p, q); });
}

std::vector<WallId> wallsOf(const DetectedRoom& room) {
  std::vector<WallId> walls;
  for (const BoundingWall& wall : room.walls) walls.push_back(wall.id);
  return walls;
}

/// What the graph is to know of the rooms, where their anchors have them now.
/// @param nodes  None: passed over.
std::vector<RoomAttributes> attributesOf(const std::vector<DetectedRoom>& rooms,
                                         const std::vector<std::optional<RoomId>>& nodes,
                                         const LayeredGraph& graph) {
  std::vector<RoomAttributes> result(rooms.size());
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    if (!nodes[k]) continue;
    const DetectedRoom& room = rooms[k];
    const Pose T_map_anchor = graph.pose(room.anchor);
    RoomAttributes& attributes = result[k];
    attributes.kind = room.kind;
    attributes.floor = room.floor;
    attributes.size_m = room.size_m;
    attributes.extent_map = T_map_anchor * room.extent_anchor;
    attributes.height_m = room.height_m;
    attributes.walls = wallsOf(room);
    for (const DetectedDoorway& doorway : room.doorways) {
      const std::optional<RoomId> to = doorway.to ? nodes.at(*doorway.to) : std::nullopt;
      attributes.doorways.push_back({to, T_map_anchor * doorway.centre_anchor, doorway.width_m});
    }
  }
  return result;
}

/// Who comes into a room by a doorway gets out of it by the same one.
void makeDoorwaysMutual(const std::vector<DetectedRoom>& rooms,
                        const std::vector<std::optional<RoomId>>& nodes,
                        std::vector<RoomAttributes>* attributes) {
  constexpr double kSameDoorway_m = 1.0;
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    if (!nodes[k]) continue;
    for (std::size_t j = 0; j < rooms[k].doorways.size(); ++j) {
      const Doorway doorway = (*attributes)[k].doorways[j];
      if (!doorway.to) continue;
      std::vector<Doorway>& others = (*attributes)[*rooms[k].doorways[j].to].doorways;
      const bool is_there = std::any_of(others.begin(), others.end(), [&](const Doorway& other) {
        return other.to == nodes[k] &&
               (other.centre_map - doorway.centre_map).norm() < kSameDoorway_m;
      });
      if (!is_there) others.push_back({nodes[k], doorway.centre_map, doorway.width_m});
    }
  }
}

/// Without what the graph has lost since, and without repetitions.
DetectedRoom inGraph(DetectedRoom room, const LayeredGraph& graph) {
  std::set<WallId> taken;
  const auto is_none = [&](const BoundingWall& wall) {
    return !graph.contains(wall.id) || !taken.insert(wall.id).second;
  };
  std::vector<BoundingWall> walls;
  std::remove_copy_if(room.walls.begin(), room.walls.end(), std::back_inserter(walls), is_none);
  room.walls = walls;
  if (room.floor && !graph.contains(*room.floor)) room.floor.reset();
  return room;
}

}  // namespace

bool RoomLayer::update(const RoomDetection& detection, LayeredGraph* graph) {
  grown_.clear();
  std::vector<DetectedRoom> rooms;
  for (const DetectedRoom& room : detection.rooms) rooms.push_back(inGraph(room, *graph));
  std::vector<std::optional<RoomId>> nodes = matchRooms(rooms, *graph);
  bool changed = eraseAllBut(nodes, rooms, graph);
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    if (!graph->contains(rooms[k].anchor)) continue;  // nobody can say where it is
    if (nodes[k]) {
      rooms[k] = turnedTo(graph->pose(*nodes[k]), *graph, rooms[k]);
    } else {
      nodes[k] = graph->addRoom(graph->pose(rooms[k].anchor) * rooms[k].T_anchor_room, {});
    }
  }
  std::vector<RoomAttributes> attributes = attributesOf(rooms, nodes, *graph);
  makeDoorwaysMutual(rooms, nodes, &attributes);
  names_.giveBack(nodes, attributes, graph);
  updateExactness(rooms, *graph);
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    if (!nodes[k]) continue;
    const bool has_grown = graph->attributes(*nodes[k]).walls != attributes[k].walls;
    if (!bringInLine(*nodes[k], rooms[k], attributes[k], graph)) continue;
    if (has_grown) grown_.push_back(*nodes[k]);
    changed = true;
  }
  assignKeyframes(detection, nodes, graph);
  return changed;
}

RoomLayer::Known RoomLayer::shapeOf(const DetectedRoom& room, const RoomAttributes& attributes,
                                    const Pose& T_map_room, const LayeredGraph& graph) {
  const Pose T_anchor_map = graph.pose(room.anchor).inverse();
  Known known{room, attributes.doorways, T_map_room.inverse() * graph.pose(room.anchor)};
  for (Doorway& doorway : known.doorways_anchor) {
    doorway.centre_map = T_anchor_map * doorway.centre_map;
  }
  return known;
}

bool RoomLayer::eraseAllBut(const std::vector<std::optional<RoomId>>& nodes,
                            const std::vector<DetectedRoom>& rooms, LayeredGraph* graph) {
  std::set<KeyframeId> in_rooms;
  for (const DetectedRoom& room : rooms) {
    in_rooms.insert(room.keyframes.begin(), room.keyframes.end());
  }
  struct Keyframes {
    int all = 0;
    int in_others = 0;
  };
  std::map<RoomId, Keyframes> keyframes_of;
  for (uint32_t slot = 0; slot < graph->size(Layer::kKeyframe); ++slot) {
    const KeyframeId id{graph->nodeAt({Layer::kKeyframe, slot}).value};
    const std::optional<RoomId> room = graph->attributes(id).room;
    if (!room) continue;
    ++keyframes_of[*room].all;
    if (in_rooms.count(id) > 0) ++keyframes_of[*room].in_others;
  }

  std::vector<RoomId> gone;
  for (uint32_t slot = 0; slot < graph->size(Layer::kRoom); ++slot) {
    const RoomId id{graph->nodeAt({Layer::kRoom, slot}).value};
    if (std::find(nodes.begin(), nodes.end(), id) != nodes.end()) {
      missed_.erase(id);
      continue;
    }
    const Keyframes& keyframes = keyframes_of[id];
    const bool is_taken = 2 * keyframes.in_others >= keyframes.all;
    if (is_taken || ++missed_[id] >= kMaxMissed) gone.push_back(id);
  }
  for (const RoomId id : gone) {
    names_.remember(id, known_[id].room.anchor, *graph);
    graph->eraseNode(id);
    known_.erase(id);
    missed_.erase(id);
  }
  // those that are found get their doorways anew; the others keep theirs, if not the way to nowhere
  for (const auto& [id, times] : missed_) {
    RoomAttributes attributes = graph->attributes(id);
    for (auto* doorways : {&attributes.doorways, &known_[id].doorways_anchor}) {
      for (Doorway& doorway : *doorways) {
        if (doorway.to && !graph->contains(*doorway.to)) doorway.to.reset();
      }
    }
    graph->setAttributes(id, attributes);
  }
  return !gone.empty();
}

void RoomLayer::updateExactness(const std::vector<DetectedRoom>& rooms, const LayeredGraph& graph) {
  // it takes all sightings of all walls: not for each keyframe, but whenever walls have come or
  // there is clearly more of them
  constexpr double kMore = 1.1;
  std::vector<WallId> walls;
  for (const DetectedRoom& room : rooms) {
    for (const BoundingWall& wall : room.walls) walls.push_back(wall.id);
  }
  const double keyframes = static_cast<double>(graph.size(Layer::kKeyframe));
  if (!config_.factors || (walls == measured_walls_ && keyframes < kMore * measured_keyframes_)) {
    return;
  }
  measured_walls_ = walls;
  measured_keyframes_ = keyframes;
  const RightAngles least{config_.least_right_angle_sigma_rad, config_.least_upright_sigma_rad,
                          config_.least_floor_sigma_rad};
  exactness_ = rightAnglesOf(rooms, config_.max_angle_rad, least, graph);
}

bool RoomLayer::bringInLine(RoomId id, const DetectedRoom& room, RoomAttributes attributes,
                            LayeredGraph* graph) {
  const RoomAttributes& before = graph->attributes(id);
  attributes.name =
      isNamedByUser(id, before) ? before.name : defaultRoomName(attributes.kind, id);
  const bool is_new = known_.count(id) == 0;
  Known& known = known_[id];
  if (is_new || !isSame(attributes, before)) {
    known = shapeOf(room, attributes, graph->pose(id), *graph);
    graph->setAttributes(id, attributes);
  }
  const bool changed =
      exchangeFactors(id, roomFactors(id, room, config_, exactness_, *graph), graph);
  if (changed) {
    graph->setPose(id, graph->pose(room.anchor) * room.T_anchor_room);
    known.T_room_anchor.reset();
  }
  return changed;
}

void RoomLayer::assignKeyframes(const RoomDetection& detection,
                                const std::vector<std::optional<RoomId>>& nodes,
                                LayeredGraph* graph) const {
  std::map<KeyframeId, RoomId> room_of;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!nodes[k]) continue;
    for (const KeyframeId keyframe : detection.rooms[k].keyframes) room_of[keyframe] = *nodes[k];
  }
  for (uint32_t slot = 0; slot < graph->size(Layer::kKeyframe); ++slot) {
    const KeyframeId id{graph->nodeAt({Layer::kKeyframe, slot}).value};
    const KeyframeAttributes& keyframe = graph->attributes(id);
    const bool is_newer = keyframe.stamp_s > detection.stamp_s;
    if (is_newer && (!keyframe.room || graph->contains(*keyframe.room))) continue;
    const auto found = room_of.find(id);
    const std::optional<RoomId> room =
        found == room_of.end() ? std::nullopt : std::optional<RoomId>(found->second);
    if (keyframe.room == room) continue;
    const bool is_missed = !room && keyframe.room && missed_.count(*keyframe.room) > 0;
    if (is_missed) continue;
    KeyframeAttributes assigned = keyframe;
    assigned.room = room;
    graph->setAttributes(id, assigned);
  }
}

void RoomLayer::mend(LayeredGraph* graph) {
  if (graph->losses() == losses_) return;
  losses_ = graph->losses();
  for (auto& [id, known] : known_) {
    if (!graph->contains(id) || !graph->contains(known.room.anchor)) continue;
    RoomAttributes attributes = graph->attributes(id);
    DetectedRoom room = known.room;
    room.floor = attributes.floor;  // another one, where two have become one
    room = inGraph(room, *graph);
    const bool is_whole =
        room.walls.size() == known.room.walls.size() && room.floor == known.room.floor;
    known.room = room;
    if (is_whole) continue;
    attributes.walls = wallsOf(room);
    attributes.floor = room.floor;
    graph->setAttributes(id, attributes);
    exchangeFactors(id, roomFactors(id, room, config_, exactness_, *graph), graph);
  }
}

void RoomLayer::follow(LayeredGraph* graph) {
  for (auto& [id, known] : known_) {
    if (!graph->contains(id) || !graph->contains(known.room.anchor)) continue;
    const Pose T_map_room = graph->pose(id);
    if (!known.T_room_anchor)
      known.T_room_anchor = T_map_room.inverse() * graph->pose(known.room.anchor);
    const Pose T_map_shape = T_map_room * *known.T_room_anchor;
    RoomAttributes attributes = graph->attributes(id);
    attributes.extent_map = T_map_shape * known.room.extent_anchor;
    attributes.doorways = known.doorways_anchor;
    for (Doorway& doorway : attributes.doorways) {
      doorway.centre_map = T_map_shape * doorway.centre_map;
    }
    graph->setAttributes(id, attributes);
  }
}

}  // namespace mrpt_sgraphs
