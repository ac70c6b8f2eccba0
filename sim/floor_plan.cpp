// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/floor_plan.h"

#include <algorithm>
#include <limits>

#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// What doors leave of a wall face.
std::vector<Segment> solidParts(const WallFace& face) {
  std::vector<FaceOpening> doors;
  for (const FaceOpening& opening : face.openings) {
    if (!opening.window) doors.push_back(opening);
  }
  std::sort(doors.begin(), doors.end(),
            [](const FaceOpening& a, const FaceOpening& b) { return a.begin_m < b.begin_m; });
  std::vector<Segment> parts;
  double from = 0.0;
  for (const FaceOpening& door : doors) {
    parts.emplace_back(face.first + from * face.along(), face.first + door.begin_m * face.along());
    from = door.end_m;
  }
  parts.emplace_back(face.first + from * face.along(), face.second);
  return parts;
}

}  // namespace

FloorPlan::FloorPlan(const Building& building, size_t storey) {
  for (const Room& room : building.rooms) {
    if (room.storey == storey) open_.push_back(room.outline);
  }
  for (const WallFace& face : wallFaces(building)) {
    if (face.storey != storey) continue;
    for (const Segment& part : solidParts(face)) walls_.push_back(part);
  }
  for (const Door& door : building.doors) {
    if (door.storey != storey) continue;
    const DoorEdge a = doorEdge(building, door, 0);
    const DoorEdge b = doorEdge(building, door, 1);
    open_.push_back({a.end, a.begin, b.end, b.begin});
    walls_.emplace_back(a.begin, b.end);
    walls_.emplace_back(a.end, b.begin);
  }
  for (const Furniture& piece : building.furniture) {
    if (piece.storey != storey) continue;
    footprints_.push_back(rectangle(piece.at, {piece.size_m[0], piece.size_m[1]}, piece.yaw_rad));
  }
  for (const Pillar& pillar : building.pillars) {
    if (pillar.storey != storey) continue;
    if (pillar.radius_m) {
      rounds_.push_back({pillar.at, *pillar.radius_m});
    } else {
      footprints_.push_back(rectangle(pillar.at, pillar.size_m, pillar.yaw_rad));
    }
  }
  for (const Flight& flight : building.flights) {
    if (flight.lower_storey == storey || flight.upper_storey == storey) {
      footprints_.push_back(flight.footprint());
    }
  }
}

bool FloorPlan::isOpen(const Eigen::Vector2d& point_map) const {
  return std::any_of(open_.begin(), open_.end(),
                     [&](const Polygon2& outline) { return contains(outline, point_map); });
}

double FloorPlan::clearance(const Eigen::Vector2d& point_map) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls_) {
    nearest = std::min(nearest, distanceToSegment(point_map, wall.first, wall.second));
  }
  // Passages end exactly at the faces; a point on such a line may count as in neither.
  constexpr double kRounding_m = 1e-6;
  if (!isOpen(point_map) && !isOpen(point_map + Eigen::Vector2d::Constant(kRounding_m))) {
    return -nearest;
  }
  for (const Polygon2& footprint : footprints_) {
    const double distance = distanceToOutline(footprint, point_map);
    nearest = std::min(nearest, contains(footprint, point_map) ? -distance : distance);
  }
  for (const Round& round : rounds_) {
    nearest = std::min(nearest, (point_map - round.centre).norm() - round.radius_m);
  }
  return nearest;
}

}  // namespace mrpt_sgraphs::sim
