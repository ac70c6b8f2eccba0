// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "room_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "min_cut.h"
#include "mrpt_sgraphs/geometry/cell_outline.h"
#include "room_plan.h"

namespace mrpt_sgraphs {
namespace {

/// What it costs to have a face in the room, or not [m^2].
struct FaceCost {
  double inside = 0.0;
  double outside = 0.0;
};

/// Where a convex outline cuts the level line at y: from, to; none: to is not above from.
std::pair<double, double> spanAt(const Outline2& corners, double y) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::pair<double, double> span{infinity, -infinity};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d& a = corners[k];
    const Eigen::Vector2d& b = corners[(k + 1) % corners.size()];
    if ((a.y() < y) == (b.y() < y)) continue;
    const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    span = {std::min(span.first, x), std::max(span.second, x)};
  }
  return span;
}

FaceCost costOf(const LineArrangement::Face& face, const RegionMap& map, int region,
                const FreeSpace& space) {
  constexpr double kUnknown = 0.3;   // next to nothing is known of it
  constexpr double kOccupied = 0.1;  // furniture, or the wall itself
  const double cell_m2 = map.cell_m * map.cell_m;
  const auto by_y = [](const auto& a, const auto& b) { return a.y() < b.y(); };
  const auto [low, high] = std::minmax_element(face.corners.begin(), face.corners.end(), by_y);
  FaceCost cost;
  Cell cell = cellAt(*low, map.cell_m);
  for (const int last_row = cellAt(*high, map.cell_m).row; cell.row <= last_row; ++cell.row) {
    // the cells whose centres are inside
    const auto [from, to] = spanAt(face.corners, (cell.row + 0.5) * map.cell_m);
    if (!(to > from)) continue;
    const int end = static_cast<int>(std::ceil(to / map.cell_m - 0.5));
    for (cell.column = static_cast<int>(std::ceil(from / map.cell_m - 0.5)); cell.column < end;
         ++cell.column) {
      const int there = map.region.valueOr(cell, RegionMap::kNone);
      if (there == region) {
        cost.outside += cell_m2;
      } else if (there != RegionMap::kNone) {
        cost.inside += cell_m2;
      } else {
        const FreeSpace::Space what = space.at(cell);
        if (what == FreeSpace::Space::kUnknown) cost.inside += kUnknown * cell_m2;
        if (what == FreeSpace::Space::kOccupied) cost.inside += kOccupied * cell_m2;
      }
    }
  }
  return cost;
}

/// Only those that hang together with the one that most of the region lies in.
std::vector<bool> largestPart(const LineArrangement& arrangement,
                              const std::vector<double>& region_m2,
                              const std::vector<bool>& is_inside) {
  std::vector<bool> part(is_inside.size(), false);
  std::vector<bool> best = part;
  double most_m2 = 0.0;
  for (std::size_t seed = 0; seed < is_inside.size(); ++seed) {
    if (!is_inside[seed] || part[seed]) continue;
    std::vector<bool> reached(is_inside.size(), false);
    reached[seed] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (const LineArrangement::Border& border : arrangement.borders) {
        if (reached[border.front] == reached[border.back]) continue;
        if (!is_inside[border.front] || !is_inside[border.back]) continue;
        reached[border.front] = reached[border.back] = true;
        grows = true;
      }
    }
    double area_m2 = 0.0;
    for (std::size_t f = 0; f < reached.size(); ++f) {
      if (!reached[f]) continue;
      part[f] = true;
      area_m2 += region_m2[f];
    }
    if (area_m2 <= most_m2) continue;
    most_m2 = area_m2;
    best = reached;
  }
  return best;
}

}  // namespace

RoomOutline roomOutlineOf(const RegionMap& map, int region, const FreeSpace& space,
                          const std::vector<WallLine>& walls,
                          const std::vector<WallLine>& barriers) {
  const RoomPlan plan = planOf(map, region, barriers);

  constexpr double kOpen_m = 0.5;  // what a metre of outline without a wall costs [m^2]
  const double certain = std::numeric_limits<double>::max();
  MinCut cut(plan.arrangement.faces.size());
  std::vector<double> region_m2;
  for (std::size_t f = 0; f < plan.arrangement.faces.size(); ++f) {
    const LineArrangement::Face& face = plan.arrangement.faces[f];
    const FaceCost cost = costOf(face, map, region, space);
    const bool is_border =
        std::count(face.lines.begin(), face.lines.end(), LineArrangement::kFrame) > 0;
    cut.setCosts(f, is_border ? certain : cost.inside, cost.outside);
    region_m2.push_back(cost.outside);
  }
  for (const LineArrangement::Border& border : plan.arrangement.borders) {
    const double length_m = border.end - border.begin;
    const double front_m = boundedLength(border, true, plan, barriers);
    const double back_m = boundedLength(border, false, plan, barriers);
    cut.addBorder(border.front, border.back, kOpen_m * (length_m - front_m),
                  kOpen_m * (length_m - back_m));
  }
  const std::vector<bool> is_inside = largestPart(plan.arrangement, region_m2, cut.solve());

  RoomOutline outline;
  std::vector<double> on_wall_m(walls.size(), 0.0);
  for (const LineArrangement::Border& border : plan.arrangement.borders) {
    if (is_inside[border.front] == is_inside[border.back]) continue;
    outline.length_m += border.end - border.begin;
    outline.bounded_m += boundedLength(border, is_inside[border.front], plan, barriers);
    const Line2& line = plan.lines[border.line];
    for (const std::size_t k : plan.barriers[border.line]) {
      if (walls[k].looksAlong(line) != is_inside[border.front]) continue;
      const auto [begin, end] = walls[k].spanOn(line);
      const double shared_m = std::min(border.end, end) - std::max(border.begin, begin);
      on_wall_m[k] += std::max(0.0, shared_m);
    }
  }
  constexpr double kShortestWall_m = 0.3;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    if (on_wall_m[k] > kShortestWall_m) outline.walls.push_back(walls[k].id);
  }
  constexpr double kSmallestHole_m2 = 0.5;
  for (Outline2& ring : outlinesOf(plan.arrangement, plan.lines, is_inside)) {
    const double area_m2 = signedArea(ring);
    if (outline.extent.outline.empty() && area_m2 > 0.0) {
      outline.extent.outline = std::move(ring);
    } else if (area_m2 < -kSmallestHole_m2) {
      std::reverse(ring.begin(), ring.end());
      outline.extent.holes.push_back(std::move(ring));
    }
  }
  return outline;
}

}  // namespace mrpt_sgraphs
