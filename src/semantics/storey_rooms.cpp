// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "storey_rooms.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "region_map.h"
#include "room_outline.h"
#include "room_shape.h"

namespace mrpt_sgraphs {
namespace {

Eigen::Vector2d placeOf(const KeyframeNode& keyframe, const Pose& T_floor_map) {
  return (T_floor_map * keyframe.T_map_base.translation()).head<2>();
}

/// Those within an outline that are not a storey away.
std::vector<const KeyframeNode*> keyframesIn(const FlatExtent& extent,
                                             const std::vector<const KeyframeNode*>& keyframes,
                                             const Pose& T_floor_map) {
  constexpr double kStorey_m = 3.0;
  std::vector<const KeyframeNode*> inside;
  std::copy_if(keyframes.begin(), keyframes.end(), std::back_inserter(inside),
               [&](const KeyframeNode* keyframe) {
                 const Eigen::Vector3d at = T_floor_map * keyframe->T_map_base.translation();
                 return std::abs(at.z()) < kStorey_m && contains(extent, at.head<2>());
               });
  return inside;
}

/// Numbers of the regions that keyframes stand in.
std::set<int> enteredRegions(const RegionMap& map,
                             const std::vector<const KeyframeNode*>& keyframes,
                             const Pose& T_floor_map) {
  std::set<int> regions;
  for (const KeyframeNode* keyframe : keyframes) {
    const int region = map.regionAt(placeOf(*keyframe, T_floor_map));
    if (region != RegionMap::kNone) regions.insert(region);
  }
  return regions;
}

Pose poseOf(const RoomShape& shape) {
  Pose T_floor_room = Pose::Identity();
  T_floor_room.linear() =
      Eigen::AngleAxisd(shape.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_floor_room.translation().head<2>() = shape.centre;
  return T_floor_room;
}

/// What an outline and its walls tell of a room.
DetectedRoom roomOf(const RoomOutline& outline, const std::vector<WallLine>& lines,
                    const Pose& T_anchor_floor) {
  DetectedRoom room;
  const RoomShape shape = shapeOf(outline.extent);
  room.kind = shape.kind;
  room.size_m = shape.size_m;
  room.T_anchor_room = T_anchor_floor * poseOf(shape);
  room.extent_anchor = T_anchor_floor * lifted(outline.extent, PlaneFrame{});
  for (const WallLine& line : lines) {
    if (std::find(outline.walls.begin(), outline.walls.end(), line.id) == outline.walls.end()) {
      continue;
    }
    room.walls.push_back({line.id, axisOf(line, shape)});
    room.height_m = std::max(room.height_m, line.top_m);
  }
  return room;
}

/// Openings that are ways: a door in a thick wall once, in the middle of it.
std::vector<RegionMap::Opening> doorwaysOf(const RegionMap& map) {
  constexpr double kNarrowest_m = 0.45;  // less is a gap in the data, not a way
  constexpr double kSamePlace_m = 0.8;
  std::vector<RegionMap::Opening> doorways;
  for (RegionMap::Opening opening : map.openings) {
    if (opening.width_m < kNarrowest_m) continue;
    if (opening.front > opening.back) std::swap(opening.front, opening.back);
    const auto same = std::find_if(doorways.begin(), doorways.end(), [&](const auto& other) {
      return other.front == opening.front && other.back == opening.back &&
             (other.centre - opening.centre).norm() < kSamePlace_m;
    });
    if (same == doorways.end()) {
      doorways.push_back(opening);
    } else {
      same->centre = 0.5 * (same->centre + opening.centre);
      same->width_m = std::min(same->width_m, opening.width_m);
    }
  }
  return doorways;
}

}  // namespace

bool StoreyRooms::integrate(const std::vector<const KeyframeNode*>& keyframes,
                            const Pose& T_floor_map) {
  return placed_.update(
      keyframes, T_floor_map,
      [this](const Cloud& cloud, const Pose& T_floor_base) { space_.add(cloud, T_floor_base); },
      [this](const Cloud& cloud, const Pose& T_floor_base) { space_.remove(cloud, T_floor_base); });
}

std::vector<DetectedRoom> StoreyRooms::detect(const std::vector<const KeyframeNode*>& keyframes,
                                              const std::vector<const KeyframeNode*>& passing,
                                              const SharedVector<WallNode>& walls,
                                              const Pose& T_floor_map) const {
  const FreeSpaceConfig& slab = config_.free_space;
  const std::vector<WallLine> lines =
      wallLinesOf(walls, floor_, T_floor_map, {slab.min_height_m, slab.max_height_m});
  const std::vector<WallLine> barriers =
      barriersOf(lines, config_.max_door_m, config_.max_passage_m);
  const RegionMap map = regionsOf(space_, barriers, config_.max_passage_m);

  struct Found {
    int region;
    DetectedRoom room;
    Pose T_anchor_floor;
  };
  std::vector<Found> found;
  for (const int region : enteredRegions(map, keyframes, T_floor_map)) {
    const RoomOutline outline = roomOutlineOf(map, region, space_, lines, barriers);
    if (outline.extent.outline.empty() || areaOf(outline.extent) < config_.min_area_m2) continue;
    if (outline.bounded_m < config_.min_bounded * outline.length_m) continue;
    const auto inside = keyframesIn(outline.extent, keyframes, T_floor_map);
    if (inside.empty()) continue;
    const Pose T_anchor_floor = (T_floor_map * inside.front()->T_map_base).inverse();
    DetectedRoom room = roomOf(outline, lines, T_anchor_floor);
    // where a third of the way is on stairs
    const auto on_stairs = keyframesIn(outline.extent, passing, T_floor_map);
    if (inside.size() <= 2 * on_stairs.size()) room.kind = RoomAttributes::Kind::kStairwell;
    room.floor = floor_;
    room.anchor = inside.front()->id;
    for (const KeyframeNode* keyframe : inside) room.keyframes.push_back(keyframe->id);
    found.push_back({region, std::move(room), T_anchor_floor});
  }

  const auto indexOf = [&found](int region) -> std::optional<std::size_t> {
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k].region == region) return k;
    }
    return std::nullopt;
  };
  for (const RegionMap::Opening& doorway : doorwaysOf(map)) {
    const auto a = indexOf(doorway.front);
    const auto b = indexOf(doorway.back);
    for (const auto& [from, to] : {std::make_pair(a, b), std::make_pair(b, a)}) {
      if (!from) continue;
      const Eigen::Vector3d centre(doorway.centre.x(), doorway.centre.y(), 0.0);
      found[*from].room.doorways.push_back(
          {to, found[*from].T_anchor_floor * centre, doorway.width_m});
    }
  }
  std::vector<DetectedRoom> result;
  for (Found& each : found) result.push_back(std::move(each.room));
  return result;
}

}  // namespace mrpt_sgraphs
