// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/mapping/floor_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mrpt_sgraphs {
namespace {

double heightAbove(const Plane& ground_map, const Eigen::Vector3d& point_map) {
  return ground_map.normal.dot(point_map) - ground_map.distance;
}

double groundAt(const Plane& ground_map, const Eigen::Vector2d& at) {
  const Eigen::Vector3d& n = ground_map.normal;
  return (ground_map.distance - n.head<2>().dot(at)) / n.z();
}

bool isGround(const Plane& ground_map) {
  constexpr double kSteepest = 0.5;  // as the cosine of its slope: what is steeper is a mistake
  return ground_map.normal.z() > kSteepest;
}

/// Which floor a place is of, where two lie beside each other and not a storey apart: tiles of a
/// metre, each asked once.
class FloorOfTile {
 public:
  /// @param storey_m  Floors whose grounds are farther apart do not get into each other's way.
  FloorOfTile(const GraphSnapshot& graph, double storey_m) : storey_m_(storey_m) {
    for (const FloorNode& floor : graph.floors) {
      if (isGround(floor.ground_map)) grounds_.emplace(floor.id, floor.ground_map);
    }
    for (const KeyframeNode& keyframe : graph.keyframes) {
      if (!keyframe.floor || grounds_.count(*keyframe.floor) == 0) continue;
      const Eigen::Vector2d at = keyframe.T_map_base.translation().head<2>();
      places_.push_back({at, groundAt(grounds_.at(*keyframe.floor), at), *keyframe.floor});
    }
  }

  bool isOf(FloorId floor, const Eigen::Vector2d& at) {
    if (grounds_.size() < 2) return true;
    constexpr double kTile_m = 1.0;
    const Cell tile = cellAt(at, kTile_m);
    const auto known = owners_.try_emplace({floor, {tile.column, tile.row}}, floor);
    if (known.second) {
      const Eigen::Vector2d middle(tile.column + 0.5, tile.row + 0.5);
      known.first->second = nearestFloor(floor, kTile_m * middle);
    }
    return known.first->second == floor;
  }

 private:
  struct Place {
    Eigen::Vector2d at_map;
    double ground_m;
    FloorId floor;
  };

  FloorId nearestFloor(FloorId asked, const Eigen::Vector2d& at_map) const {
    const double ground_m = groundAt(grounds_.at(asked), at_map);
    FloorId nearest = asked;
    double least = std::numeric_limits<double>::infinity();
    for (const Place& place : places_) {
      if (std::abs(place.ground_m - ground_m) > storey_m_) continue;
      const double distance2 = (place.at_map - at_map).squaredNorm();
      if (distance2 >= least) continue;
      least = distance2;
      nearest = place.floor;
    }
    return nearest;
  }

  double storey_m_;
  std::map<FloorId, Plane> grounds_;
  std::vector<Place> places_;
  std::map<std::pair<FloorId, std::pair<int, int>>, FloorId> owners_;
};

FloorGrid gridOf(const FloorNode& floor, const OccupancyMap& map, const MapConfig& config,
                 FloorOfTile* floors) {
  FloorGrid grid;
  grid.floor = floor.id;
  grid.cell_m = map.cell_m();
  CellBox box;
  std::vector<std::pair<Cell, bool>> band;
  map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    const Eigen::Vector3d centre_map = map.centreOf(voxel);
    const double height_m = heightAbove(floor.ground_map, centre_map);
    if (height_m < config.min_height_m || height_m > config.max_height_m) return;
    if (!floors->isOf(floor.id, centre_map.head<2>())) return;
    const Cell cell{voxel[0], voxel[1]};
    box = box.united({cell, cell});
    band.emplace_back(cell, is_occupied);
  });
  if (band.empty()) return grid;
  grid.cells = CellGrid<std::int8_t>(box, FloorGrid::kUnknown);
  for (const auto& [cell, is_occupied] : band) {
    std::int8_t& value = grid.cells[cell];
    value = std::max(value, is_occupied ? FloorGrid::kOccupied : FloorGrid::kFree);
  }
  const Eigen::Vector2d middle(0.5 * (box.min.column + box.max.column + 1),
                               0.5 * (box.min.row + box.max.row + 1));
  grid.ground_m = groundAt(floor.ground_map, grid.cell_m * middle);
  return grid;
}

}  // namespace

bool operator==(const FloorGrid& a, const FloorGrid& b) {
  if (!(a.floor == b.floor) || a.cell_m != b.cell_m || a.ground_m != b.ground_m ||
      !(a.cells.box().min == b.cells.box().min) || !(a.cells.box().max == b.cells.box().max)) {
    return false;
  }
  bool same = true;
  a.cells.forEach([&](Cell cell) { same = same && a.cells[cell] == b.cells[cell]; });
  return same;
}

std::vector<FloorGrid> floorGrids(const OccupancyMap& map, const GraphSnapshot& graph,
                                  const MapConfig& config) {
  std::vector<FloorGrid> grids;
  FloorOfTile floors(graph, config.max_height_m);
  for (const FloorNode& floor : graph.floors) {
    if (!isGround(floor.ground_map)) continue;
    FloorGrid grid = gridOf(floor, map, config, &floors);
    if (!grid.cells.box().empty()) grids.push_back(std::move(grid));
  }
  return grids;
}

}  // namespace mrpt_sgraphs
