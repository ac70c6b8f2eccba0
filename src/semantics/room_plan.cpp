// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "room_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mrpt_sgraphs/geometry/cell_outline.h"

namespace mrpt_sgraphs {
namespace {

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
                  RoomPlan* plan) {
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
void addBox(const CellBox& box, double cell_m, RoomPlan* plan) {
  const Eigen::Vector2d low = cell_m * Eigen::Vector2d(box.min.column, box.min.row);
  const Eigen::Vector2d high = cell_m * Eigen::Vector2d(box.max.column + 1, box.max.row + 1);
  for (const Line2& line : {Line2{{1.0, 0.0}, low.x()}, Line2{{-1.0, 0.0}, -high.x()},
                            Line2{{0.0, 1.0}, low.y()}, Line2{{0.0, -1.0}, -high.y()}}) {
    plan->lines.push_back(line);
    plan->barriers.emplace_back();
  }
}

}  // namespace

RoomPlan planOf(const RegionMap& map, int region, const std::vector<WallLine>& barriers) {
  constexpr double kSupport_m = 0.5;
  RoomPlan plan;
  const CellSet cells = cellsOf(map, region);
  const Support support = supportOf(edgeOf(cells), barriers, map.cell_m);
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

double boundedLength(const LineArrangement::Border& border, bool in_front, const RoomPlan& plan,
                     const std::vector<WallLine>& barriers) {
  const Line2& line = plan.lines[border.line];
  double length_m = 0.0;
  double until_m = border.begin;  // barriers may overlap
  std::vector<std::pair<double, double>> spans;
  for (const std::size_t k : plan.barriers[border.line]) {
    if (barriers[k].looksAlong(line) == in_front) spans.push_back(barriers[k].spanOn(line));
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

}  // namespace mrpt_sgraphs
