// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "storey_plan.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

/// Surfaces so near to each other are one, and rays so far from all surfaces went through.
constexpr double kSame_m = 0.2;
constexpr double kOther_m = 0.3;

int reachInCells(double cell_m) {
  return static_cast<int>(std::ceil(StoreyPlan::kReach_m / cell_m));
}

Eigen::Vector2d middleOf(Cell cell, double cell_m) {
  return {(cell.column + 0.5) * cell_m, (cell.row + 0.5) * cell_m};
}

/// The cells of the plan in which a wall stands at the height of the slab.
CellSet cellsOf(const WallLine& wall, const Slab& slab, double cell_m) {
  CellSet cells;
  rasterized(wall.extent, cell_m).forEach([&](Cell seen) {
    const Eigen::Vector2d middle = middleOf(seen, cell_m);  // along the wall and above the ground
    if (middle.y() < slab.bottom_m || middle.y() > slab.top_m) return;
    cells.add(cellAt(wall.at(middle.x()), cell_m));
  });
  return cells;
}

/// How many surfaces of one plan are the other one's too, and through how many its rays went.
void count(const StoreyPlan& known, const StoreyPlan& plan, const Eigen::Isometry2d& T_known_plan,
           int* agree, int* against) {
  for (const Eigen::Vector2d& surface : plan.surfaces()) {
    const Eigen::Vector2d at = T_known_plan * surface;
    const double distance_m = known.distanceAt(at);
    if (distance_m <= kSame_m) {
      ++*agree;
    } else if (distance_m > kOther_m && known.isFree(at)) {
      ++*against;
    }
  }
}

}  // namespace

StoreyPlan::StoreyPlan(const FreeSpace& space, const Slab& slab, const std::vector<WallLine>& walls,
                       const std::vector<FlatExtent>& rooms)
    : cell_m_(space.cell_m()) {
  using Seen = FreeSpace::Space;
  CellSet standing;
  for (const WallLine& wall : walls) standing.add(cellsOf(wall, slab, cell_m_));
  CellSet inside;
  for (const FlatExtent& room : rooms) inside.add(rasterized(room, cell_m_));
  CellBox box = space.box().united(standing.box()).united(inside.box());
  if (box.empty()) return;
  box = box.grown(reachInCells(cell_m_));
  distance_m_ = CellGrid<float>(box, static_cast<float>(kReach_m));
  space_ = CellGrid<Space>(box, Space::kUnknown);
  space_.forEach([&](Cell cell) {
    const Seen here = space.at(cell);
    if (here == Seen::kFree) {
      space_[cell] = Space::kFree;
    } else if (here == Seen::kOccupied || standing.contains(cell)) {
      addSurface(cell);
    } else if (inside.contains(cell)) {
      space_[cell] = Space::kRoom;
    }
  });
}

void StoreyPlan::addSurface(Cell cell) {
  surfaces_.push_back(middleOf(cell, cell_m_));
  const int reach = reachInCells(cell_m_);
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Cell near{cell.column + column, cell.row + row};
      if (!distance_m_.contains(near)) continue;
      const auto distance_m = static_cast<float>(cell_m_ * std::hypot(column, row));
      distance_m_[near] = std::min(distance_m_[near], distance_m);
    }
  }
}

PlanAgreement compare(const StoreyPlan& known, const StoreyPlan& plan,
                      const Eigen::Isometry2d& T_known_plan) {
  PlanAgreement result;
  result.surfaces = static_cast<int>(plan.surfaces().size());
  count(known, plan, T_known_plan, &result.agree, &result.against);
  result.found = result.agree;
  count(plan, known, T_known_plan.inverse(), &result.agree, &result.against);
  return result;
}

}  // namespace mrpt_sgraphs
