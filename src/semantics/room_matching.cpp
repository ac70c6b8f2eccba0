// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_matching.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {
namespace {

/// Two rooms have this much of each other's keyframes and ground, of 2, to be surely the same one,
constexpr double kSurely = 1.0;
/// and no less than this if nothing else is nearer to it.
constexpr double kAtLeast = 0.3;

Eigen::AlignedBox2d boxAround(const PlanarExtent& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : outline.outline) box.extend(corner.head<2>());
  return box;
}

/// How much of the graph's room is in the detected one: 1 for all its keyframes, 1 for all its
/// ground.
class Likeness {
 public:
  Likeness(const std::vector<DetectedRoom>& rooms, const LayeredGraph& graph)
      : rooms_(rooms), graph_(graph) {
    outlines_map_.resize(rooms.size());
    for (std::size_t k = 0; k < rooms.size(); ++k) {
      if (!graph.contains(rooms[k].anchor)) continue;
      outlines_map_[k] = graph.pose(rooms[k].anchor) * rooms[k].extent_anchor;
      for (const KeyframeId keyframe : rooms[k].keyframes) {
        if (!graph.contains(keyframe)) continue;
        const std::optional<RoomId> room = graph.attributes(keyframe).room;
        if (room) ++shared_[{*room, k}];
      }
    }
    for (uint32_t slot = 0; slot < graph.size(Layer::kKeyframe); ++slot) {
      const KeyframeId id{graph.nodeAt({Layer::kKeyframe, slot}).value};
      const std::optional<RoomId> room = graph.attributes(id).room;
      if (room) ++keyframes_[*room];
    }
  }

  double byKeyframes(RoomId id, std::size_t k) const {
    const auto shared = shared_.find({id, k});
    return shared == shared_.end() ? 0.0 : shared->second / keyframes_.at(id);
  }

  double byGround(RoomId id, std::size_t k) const {
    const RoomAttributes& room = graph_.attributes(id);
    const bool same_floor = !room.floor || !rooms_[k].floor || *room.floor == *rooms_[k].floor;
    return same_floor ? coveredShare(room.extent_map, outlines_map_[k]) : 0.0;
  }

 private:
  const std::vector<DetectedRoom>& rooms_;
  const LayeredGraph& graph_;
  std::vector<PlanarExtent> outlines_map_;
  std::map<std::pair<RoomId, std::size_t>, double> shared_;  ///< Keyframes.
  std::map<RoomId, double> keyframes_;
};

/// Which of the detected rooms the graph's room is most like, and how much; of as many the first.
std::pair<std::size_t, double> mostAlike(RoomId id, std::size_t rooms, const Likeness& likeness) {
  std::vector<std::pair<double, std::size_t>> by_keyframes;
  for (std::size_t k = 0; k < rooms; ++k) by_keyframes.emplace_back(likeness.byKeyframes(id, k), k);
  std::stable_sort(by_keyframes.begin(), by_keyframes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::pair<std::size_t, double> best{0, 0.0};
  for (const auto& [share, k] : by_keyframes) {
    if (share + 1.0 < best.second) break;  // not with all of its ground, which takes long to compare
    const double value = share + likeness.byGround(id, k);
    const bool is_as_good = value > 0.0 && value == best.second && k < best.first;
    if (value > best.second || is_as_good) best = {k, value};
  }
  return best;
}

}  // namespace

double coveredShare(const PlanarExtent& outline, const PlanarExtent& other) {
  constexpr double kCell_m = 0.15;
  if (outline.outline.size() < 3 || other.outline.size() < 3) return 0.0;
  if (!boxAround(outline).intersects(boxAround(other))) return 0.0;
  // along one of its own edges: the same whichever way the map is turned
  const Eigen::Vector3d& corner = outline.outline.front();
  PlaneFrame frame(Plane{}, corner);
  frame.u << (outline.outline[1] - corner).head<2>().normalized(), 0.0;
  frame.v = frame.normal.cross(frame.u);
  const CellSet cells = rasterized(flattened(outline, frame), kCell_m);
  if (cells.empty()) return 0.0;
  return static_cast<double>(sharedSize(cells, rasterized(flattened(other, frame), kCell_m))) /
         static_cast<double>(cells.size());
}

std::vector<std::optional<RoomId>> matchRooms(const std::vector<DetectedRoom>& rooms,
                                              const LayeredGraph& graph) {
  const Likeness likeness(rooms, graph);
  std::vector<std::optional<RoomId>> nodes(rooms.size());
  std::vector<double> best_of(rooms.size(), 0.0);
  std::map<RoomId, std::pair<std::size_t, double>> part_of;
  for (uint32_t slot = 0; slot < graph.size(Layer::kRoom); ++slot) {
    const RoomId id{graph.nodeAt({Layer::kRoom, slot}).value};
    const auto best = mostAlike(id, rooms.size(), likeness);
    if (best.second >= kAtLeast) part_of[id] = best;
  }
  // in the order of their ids: the oldest that surely is it, else the one that most likely is
  for (const auto& [id, part] : part_of) {
    const auto [k, value] = part;
    if (best_of[k] >= kSurely || value <= best_of[k]) continue;
    nodes[k] = id;
    best_of[k] = value;
  }
  return nodes;
}

DetectedRoom turnedTo(const Pose& T_map_room, const LayeredGraph& graph, DetectedRoom room) {
  const Pose T_room_detected = T_map_room.inverse() * graph.pose(room.anchor) * room.T_anchor_room;
  const double yaw = std::atan2(T_room_detected.linear()(1, 0), T_room_detected.linear()(0, 0));
  const double step = room.kind == RoomAttributes::Kind::kCorridor ? M_PI : 0.5 * M_PI;
  const double turns = std::round(yaw / step);
  if (turns == 0.0) return room;
  const Eigen::Matrix3d R = expSO3({0.0, 0.0, -turns * step});
  room.T_anchor_room.linear() = (room.T_anchor_room.linear() * R).eval();
  for (BoundingWall& wall : room.walls) wall.axis_room = (R.transpose() * wall.axis_room).eval();
  if (std::abs(std::sin(turns * step)) > 0.5) std::swap(room.size_m.x(), room.size_m.y());
  return room;
}

}  // namespace mrpt_sgraphs
