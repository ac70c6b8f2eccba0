// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "room_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "min_cut.h"
#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {
namespace {

/// The plan around a region, cut by lines that may bound it.
struct Plan {
  std::vector<Line2> lines;
  std::vector<std::vector<std::size_t>> barriers;  ///< On each line; none: edge of free space.
  LineArrangement arrangement;
};

CellSet cellsOf(const RegionMap& map, int region) {
  const CellBox box = map.boxes[static_cast<std::size_t>(region)];
  CellSet cells(box);
  for (Cell cell = box.min; cell.row <= box.max.row; ++cell.row) {
    for (cell.column = box.min.column; cell.column <= box.max.column; ++cell.column) {
      if (map.region[cell] == region) cells.add(cell);
    }
  }
  return cells;
}

/// Beside which a wall may stand.
CellSet edgeOf(const CellSet& cells) {
  CellSet edge(cells.box());
  cells.forEach([&](Cell cell) {
    const auto neighbours = neighboursOf(cell);
    const bool is_inner = std::all_of(neighbours.begin(), neighbours.end(),
                                      [&cells](Cell next) { return cells.contains(next); });
    if (!is_inner) edge.add(cell);
  });
  return edge;
}

/// How much of the edge lies in front of each wall, and near none.
struct Support {
  std::vector<double> length_m;
  CellSet free_edge;
};

Support supportOf(const CellSet& edge, const std::vector<WallLine>& barriers, double cell_m) {
  constexpr double kNear_m = 0.35;
  constexpr double kBehind_m = 0.1;  // what is on the line itself, give or take a cell
  Support support;
  support.length_m.assign(barriers.size(), 0.0);
  edge.forEach([&](Cell cell) {
    const Eigen::Vector2d centre = cell_m * Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5);
    bool is_near = false;
    for (std::size_t k = 0; k < barriers.size(); ++k) {
      const double height_m = barriers[k].line.heightOf(centre);
      if (height_m < -kBehind_m || height_m > kNear_m) continue;
      const double along_m = barriers[k].line.along().dot(centre);
      if (along_m < barriers[k].begin_m - cell_m || along_m > barriers[k].end_m + cell_m) continue;
      support.length_m[k] += cell_m;
      is_near = true;
    }
    if (!is_near) support.free_edge.add(cell);
  });
  return support;
}

/// Whether two lines are one between two points of the second.
bool isSameLine(const Line2& a, const Line2& b, const Eigen::Vector2d& from,
                const Eigen::Vector2d& to) {
  constexpr double kSame_m = 0.08;
  const double side = std::copysign(1.0, a.normal.dot(b.normal));
  return std::abs(a.heightOf(from) - side * b.heightOf(from)) < kSame_m &&
         std::abs(a.heightOf(to) - side * b.heightOf(to)) < kSame_m;
}

/// A line through the edges of the free space where no wall is near.
void addFreeEdges(const CellSet& region_cells, const CellSet& free_edge, double cell_m,
                  Plan* plan) {
  constexpr double kShortest_m = 0.6;
  constexpr double kFreeShare = 0.7;
  CellOutlineConfig config;
  config.cell_m = cell_m;
  config.max_gap_m = cell_m;
  const Outline2 outline = outlineOf(region_cells, config).outline;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Eigen::Vector2d from = outline[k];
    const Eigen::Vector2d way = outline[(k + 1) % outline.size()] - from;
    const double length_m = way.norm();
    if (length_m < kShortest_m) continue;
    const Eigen::Vector2d inward = Eigen::Vector2d(-way.y(), way.x()) / length_m;
    const int samples = static_cast<int>(length_m / cell_m);
    int free = 0;
    for (int s = 0; s < samples; ++s) {
      const Eigen::Vector2d beside = from + (s + 0.5) / samples * way + 0.5 * cell_m * inward;
      const Cell cell = cellAt(beside, cell_m);
      bool is_free = free_edge.contains(cell);
      for (const Cell next : neighboursOf(cell)) is_free = is_free || free_edge.contains(next);
      free += is_free ? 1 : 0;
    }
    if (free < kFreeShare * samples) continue;
    const Line2 line{inward, inward.dot(from)};
    const bool is_known = std::any_of(plan->lines.begin(), plan->lines.end(), [&](const Line2& l) {
      return isSameLine(l, line, from, from + way);
    });
    if (is_known) continue;
    plan->lines.push_back(line);
    plan->barriers.emplace_back();
  }
}

/// The box around the region: nothing of it lies in a face without an end, however ragged its edge.
void addBox(const CellBox& box, double cell_m, Plan* plan) {
  const Eigen::Vector2d low = cell_m * Eigen::Vector2d(box.min.column, box.min.row);
  const Eigen::Vector2d high = cell_m * Eigen::Vector2d(box.max.column + 1, box.max.row + 1);
  for (const Line2& line : {Line2{{1.0, 0.0}, low.x()}, Line2{{-1.0, 0.0}, -high.x()},
                            Line2{{0.0, 1.0}, low.y()}, Line2{{0.0, -1.0}, -high.y()}}) {
    plan->lines.push_back(line);
    plan->barriers.emplace_back();
  }
}

Plan planOf(const RegionMap& map, const CellSet& cells, const CellSet& edge,
            const std::vector<WallLine>& barriers) {
  constexpr double kSupport_m = 0.5;
  Plan plan;
  const Support support = supportOf(edge, barriers, map.cell_m);
  // the longest first: of walls nearly in one line, its line is the one that is known best
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < barriers.size(); ++k) {
    const double length_m = barriers[k].end_m - barriers[k].begin_m;
    if (support.length_m[k] >= std::min(kSupport_m, 0.5 * length_m)) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return support.length_m[a] > support.length_m[b];
  });
  for (const std::size_t k : order) {
    const WallLine& barrier = barriers[k];
    std::size_t line = 0;
    while (line < plan.lines.size() &&
           !isSameLine(plan.lines[line], barrier.line, barrier.at(barrier.begin_m),
                       barrier.at(barrier.end_m))) {
      ++line;
    }
    if (line == plan.lines.size()) {
      plan.lines.push_back(barrier.line);
      plan.barriers.emplace_back();
    }
    plan.barriers[line].push_back(k);
  }
  addFreeEdges(cells, support.free_edge, map.cell_m, &plan);
  addBox(cells.box(), map.cell_m, &plan);
  constexpr int kMargin = 5;
  const CellBox box = cells.box().grown(kMargin);
  plan.arrangement =
      arrangementOf(plan.lines, map.cell_m * Eigen::Vector2d(box.min.column, box.min.row),
                    map.cell_m * Eigen::Vector2d(box.max.column + 1, box.max.row + 1));
  return plan;
}

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

/// The part of a border on walls that look to one side of it.
double boundedLength(const LineArrangement::Border& border, bool in_front, const Plan& plan,
                     const std::vector<WallLine>& barriers) {
  const Line2& line = plan.lines[border.line];
  double length_m = 0.0;
  double until_m = border.begin;  // barriers may overlap
  std::vector<std::pair<double, double>> spans;
  for (const std::size_t k : plan.barriers[border.line]) {
    const double direction = line.normal.dot(barriers[k].line.normal);
    if ((direction > 0.0) != in_front) continue;
    const double a = line.along().dot(barriers[k].at(barriers[k].begin_m));
    const double b = line.along().dot(barriers[k].at(barriers[k].end_m));
    spans.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(spans.begin(), spans.end());
  for (const auto& [begin, end] : spans) {
    const double from = std::max(begin, until_m);
    const double to = std::min(end, border.end);
    if (to <= from) continue;
    length_m += to - from;
    until_m = to;
  }
  return length_m;
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
  const CellSet cells = cellsOf(map, region);
  const Plan plan = planOf(map, cells, edgeOf(cells), barriers);

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
      if ((line.normal.dot(walls[k].line.normal) > 0.0) != is_inside[border.front]) continue;
      const double a = line.along().dot(walls[k].at(walls[k].begin_m));
      const double b = line.along().dot(walls[k].at(walls[k].end_m));
      const double shared_m =
          std::min(border.end, std::max(a, b)) - std::max(border.begin, std::min(a, b));
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
