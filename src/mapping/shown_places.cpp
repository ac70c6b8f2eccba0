// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/mapping/shown_places.h"

#include <cmath>
#include <cstddef>

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {
namespace {

/// Above the ground, so that the cube of a room stands on it.
constexpr double kRoomNodeHeight_m = 0.5;

/// A ring's area and its first moments.
struct Moments {
  double area_m2 = 0.0;
  Eigen::Vector2d first_m3 = Eigen::Vector2d::Zero();
};

/// Whichever way round the ring goes.
Moments momentsOf(const Outline2& ring) {
  Moments sum;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d& a = ring[k];
    const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    sum.area_m2 += cross / 2.0;
    sum.first_m3 += cross / 6.0 * (a + b);
  }
  return {std::abs(sum.area_m2), std::copysign(1.0, sum.area_m2) * sum.first_m3};
}

/// Of the surface; of a wall of which no extent is known, its point next to the origin.
Eigen::Vector3d centroidOf(const WallNode& wall) {
  const Eigen::Vector3d foot = wall.plane_map.distance * wall.plane_map.normal;
  if (wall.extent_map.outline.empty()) return foot;
  const PlaneFrame frame(wall.plane_map, wall.extent_map.outline.front());
  const FlatExtent extent = flattened(wall.extent_map, frame);
  Moments whole = momentsOf(extent.outline);
  for (const Outline2& hole : extent.holes) {
    const Moments open = momentsOf(hole);
    whole.area_m2 -= open.area_m2;
    whole.first_m3 -= open.first_m3;
  }
  return whole.area_m2 > 0.0 ? frame.lifted(whole.first_m3 / whole.area_m2) : foot;
}

}  // namespace

ShownPlaces::ShownPlaces(const GraphSnapshot& graph, double layer_lift_m)
    : layer_lift_m_(layer_lift_m) {
  for (const KeyframeNode& node : graph.keyframes) add(node.id, node.T_map_base.translation());
  for (const WallNode& node : graph.walls) add(node.id, centroidOf(node));
  for (const RoomNode& node : graph.rooms) {
    add(node.id, node.T_map_room.translation() + kRoomNodeHeight_m * Eigen::Vector3d::UnitZ());
  }
  for (const FloorNode& node : graph.floors) add(node.id, node.centre_map);
}

}  // namespace mrpt_sgraphs
