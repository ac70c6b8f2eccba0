// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "region_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace mrpt_sgraphs {
namespace {

constexpr int kNone = RegionMap::kNone;
constexpr int kUncharted = -2;  ///< Free, and of no region yet.

/// Cells that a line passes through, without a way between them from one side to the other.
template <typename Visit>
void visitLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double cell_m,
               const Visit& visit) {
  // at this step no cell is passed over but for its outermost corner
  const double step_m = 0.25 * cell_m;
  const int steps = static_cast<int>(std::ceil((to - from).norm() / step_m));
  std::optional<Cell> last;
  for (int k = 0; k <= steps; ++k) {
    const Cell cell =
        cellAt(from + (static_cast<double>(k) / std::max(steps, 1)) * (to - from), cell_m);
    if (last && *last == cell) continue;
    if (last && last->column != cell.column && last->row != cell.row) {
      visit(Cell{last->column, cell.row});
    }
    visit(cell);
    last = cell;
  }
}

void flood(Cell seed, int region, CellGrid<int>* regions, std::size_t* size) {
  std::vector<Cell> open{seed};
  (*regions)[seed] = region;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    ++*size;
    for (const Cell next : neighboursOf(cell)) {
      if (regions->valueOr(next, kNone) != kUncharted) continue;
      (*regions)[next] = region;
      open.push_back(next);
    }
  }
}

/// What lies behind a barrier is looked for through the thickness of a wall and the second barrier
/// on its other side; what is between the two is of no account.
class Beside {
 public:
  Beside(const FreeSpace& space, const RegionMap& map) : space_(space), map_(map) {}

  /// The region that one comes to from a point on a barrier, along a free way.
  /// @param passed  What it leads through.
  int regionOn(const Eigen::Vector2d& point, const Eigen::Vector2d& side,
               std::set<int>* passed) const {
    constexpr double kThickest_m = 0.7;
    const double step_m = 0.5 * map_.cell_m;
    for (double way_m = 0.0; way_m < kThickest_m; way_m += step_m) {
      const Cell cell = cellAt(point + way_m * side, map_.cell_m);
      if (space_.at(cell) != FreeSpace::Space::kFree) return kNone;
      const int region = map_.region.valueOr(cell, kNone);
      if (region == kNone) continue;
      if (!isThreshold(region)) return region;
      passed->insert(region);
    }
    return kNone;
  }

 private:
  /// Too small to be anything but what lies between the two faces of a wall.
  bool isThreshold(int region) const {
    constexpr double kThreshold_m2 = 1.0;
    const auto cells = static_cast<double>(map_.sizes[static_cast<std::size_t>(region)]);
    return map_.cell_m * map_.cell_m * cells < kThreshold_m2;
  }

  const FreeSpace& space_;
  const RegionMap& map_;
};

/// How far a region reaches from a point on the way to one side [m].
double reach(const RegionMap& map, int region, const Eigen::Vector2d& from,
             const Eigen::Vector2d& side) {
  double way_m = 0.0;
  while (map.regionAt(from + way_m * side) == region) way_m += 0.5 * map.cell_m;
  return way_m;
}

/// How wide a region is beside an opening, at the place near it where it is widest.
double widthBeside(const RegionMap& map, int region, const RegionMap::Opening& opening,
                   const Eigen::Vector2d& side) {
  constexpr double kDeepest_m = 1.2;
  const Eigen::Vector2d across(side.y(), -side.x());
  double widest_m = 0.0;
  for (double depth_m = 0.0; depth_m < kDeepest_m; depth_m += map.cell_m) {
    const Eigen::Vector2d at = opening.centre + depth_m * side;
    if (map.regionAt(at) != region) continue;
    widest_m = std::max(widest_m, reach(map, region, at, across) + reach(map, region, at, -across));
  }
  return widest_m;
}

/// Whether an opening parts two rooms. Where one of them is no wider than the opening there is
/// nothing to part: the barrier runs across a corridor, from wall to wall. But what a corridor
/// opens into may be another room, if it is far deeper than the corridor is wide.
bool isDoorway(const RegionMap& map, const RegionMap::Opening& opening,
               const Eigen::Vector2d& normal, double max_passage_m) {
  constexpr double kJambs_m = 0.25;  // both together
  constexpr double kDeep = 2.0;      // times the opening's width
  if (opening.width_m > max_passage_m) return false;
  const double front_m = widthBeside(map, opening.front, opening, normal);
  const double back_m = widthBeside(map, opening.back, opening, -normal);
  const bool front_is_wider = front_m > opening.width_m + kJambs_m;
  const bool back_is_wider = back_m > opening.width_m + kJambs_m;
  if (front_is_wider && back_is_wider) return true;
  if (!front_is_wider && !back_is_wider) return false;
  const int deep = front_is_wider ? opening.front : opening.back;
  const Eigen::Vector2d ahead = front_is_wider ? normal : Eigen::Vector2d(-normal);
  double ahead_m = 0.0;
  while (ahead_m < 1.0 && map.regionAt(opening.centre + ahead_m * ahead) != deep) {
    ahead_m += 0.5 * map.cell_m;
  }
  return reach(map, deep, opening.centre + ahead_m * ahead, ahead) > kDeep * opening.width_m;
}

/// Rays may pass where one cannot walk: through a window, or glass in a wall that is known.
bool isBarred(const WallLine& barrier, double along_m) {
  constexpr double kKnees_m = 0.5;
  constexpr double kWaist_m = 0.9;
  return contains(barrier.extent, {along_m, kKnees_m}) ||
         contains(barrier.extent, {along_m, kWaist_m});
}

/// An opening, and what lies between its two regions.
struct WideOpening {
  RegionMap::Opening opening;
  std::set<int> thresholds;
  int samples = 0;
  int barred = 0;  ///< Of them.
};

/// Stretches of a barrier with the same regions on both sides.
std::vector<WideOpening> openingsIn(const WallLine& barrier, const FreeSpace& space,
                                    const RegionMap& map) {
  constexpr double kSameGap_m = 0.35;  // between free places of one opening
  const Beside beside(space, map);
  std::vector<WideOpening> openings;
  double begin_m = 0.0;
  double end_m = 0.0;
  for (double at_m = barrier.begin_m; at_m <= barrier.end_m; at_m += 0.5 * map.cell_m) {
    const Eigen::Vector2d point = barrier.at(at_m);
    std::set<int> passed;
    const int front = beside.regionOn(point, barrier.line.normal, &passed);
    if (front == kNone) continue;
    const int back = beside.regionOn(point, -barrier.line.normal, &passed);
    if (back == kNone || front == back) continue;
    const bool goes_on = !openings.empty() && openings.back().opening.front == front &&
                         openings.back().opening.back == back && at_m - end_m < kSameGap_m;
    if (!goes_on) {
      openings.push_back({{front, back, {0.0, 0.0}, 0.0}, {}, 0, 0});
      begin_m = at_m;
    }
    end_m = at_m;
    openings.back().opening.centre = barrier.at(0.5 * (begin_m + end_m));
    openings.back().opening.width_m = end_m - begin_m + map.cell_m;
    openings.back().thresholds.insert(passed.begin(), passed.end());
    ++openings.back().samples;
    if (isBarred(barrier, at_m)) ++openings.back().barred;
  }
  // the edges of a door are blurred, and may be barred
  const auto is_window = [](const WideOpening& each) { return 3 * each.barred > 2 * each.samples; };
  openings.erase(std::remove_if(openings.begin(), openings.end(), is_window), openings.end());
  return openings;
}

/// Numbers that become one: each leads to a lower one, and the lowest to itself.
class Joined {
 public:
  explicit Joined(std::size_t size) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int lowestOf(int number) const {
    while (parents_[static_cast<std::size_t>(number)] != number) {
      number = parents_[static_cast<std::size_t>(number)];
    }
    return number;
  }

  void join(int a, int b) {
    const auto [lower, higher] = std::minmax({lowestOf(a), lowestOf(b)});
    parents_[static_cast<std::size_t>(higher)] = lower;
  }

 private:
  std::vector<int> parents_;
};

/// Each region gets the number of the lowest of those that it is joined with.
void apply(const Joined& joined, RegionMap* map) {
  map->region.forEach([&](Cell cell) {
    int& region = map->region[cell];
    if (region != kNone) region = joined.lowestOf(region);
  });
  for (std::size_t k = 0; k < map->sizes.size(); ++k) {
    const auto lowest = static_cast<std::size_t>(joined.lowestOf(static_cast<int>(k)));
    if (lowest != k) map->sizes[lowest] += std::exchange(map->sizes[k], 0);
  }
  std::vector<RegionMap::Opening> openings;
  for (RegionMap::Opening opening : map->openings) {
    opening.front = joined.lowestOf(opening.front);
    opening.back = joined.lowestOf(opening.back);
    if (opening.front != opening.back) openings.push_back(opening);
  }
  map->openings = std::move(openings);
}

std::vector<CellBox> boxesOf(const RegionMap& map) {
  std::vector<CellBox> boxes(map.sizes.size());
  map.region.forEach([&](Cell cell) {
    if (map.region[cell] == kNone) return;
    CellBox& box = boxes[static_cast<std::size_t>(map.region[cell])];
    box = box.united({cell, cell});
  });
  return boxes;
}

/// Cells of barriers that a region lies on both sides of become the region's.
void closeSeams(const FreeSpace& space, RegionMap* map) {
  constexpr int kWidest = 2;
  for (int pass = 0; pass < kWidest; ++pass) {
    const CellGrid<int> before = map->region;
    before.forEach([&](Cell cell) {
      if (before[cell] != kNone || space.at(cell) != FreeSpace::Space::kFree) return;
      for (const Cell step : {Cell{1, 0}, Cell{0, 1}}) {
        for (int k = 1; k <= kWidest && map->region[cell] == kNone; ++k) {
          const int ahead =
              before.valueOr({cell.column + k * step.column, cell.row + k * step.row}, kNone);
          const int behind =
              before.valueOr({cell.column - step.column, cell.row - step.row}, kNone);
          if (ahead == behind) map->region[cell] = ahead;
        }
      }
    });
  }
}

}  // namespace

RegionMap regionsOf(const FreeSpace& space, const std::vector<WallLine>& barriers,
                    double max_passage_m) {
  RegionMap map;
  map.cell_m = space.cell_m();
  map.region = CellGrid<int>(space.box(), kNone);
  map.region.forEach([&](Cell cell) {
    if (space.at(cell) == FreeSpace::Space::kFree) map.region[cell] = kUncharted;
  });
  for (const WallLine& barrier : barriers) {
    visitLine(barrier.at(barrier.begin_m), barrier.at(barrier.end_m), map.cell_m,
              [&map](Cell cell) {
                if (map.region.contains(cell)) map.region[cell] = kNone;
              });
  }
  map.region.forEach([&map](Cell cell) {
    if (map.region[cell] != kUncharted) return;
    map.sizes.push_back(0);
    flood(cell, static_cast<int>(map.sizes.size()) - 1, &map.region, &map.sizes.back());
  });

  Joined joined(map.sizes.size());
  for (const WallLine& barrier : barriers) {
    for (const WideOpening& wide : openingsIn(barrier, space, map)) {
      const RegionMap::Opening& opening = wide.opening;
      if (isDoorway(map, opening, barrier.line.normal, max_passage_m)) {
        map.openings.push_back(opening);
        continue;
      }
      joined.join(opening.front, opening.back);
      for (const int threshold : wide.thresholds) joined.join(opening.front, threshold);
    }
  }
  apply(joined, &map);
  closeSeams(space, &map);
  map.boxes = boxesOf(map);
  return map;
}

}  // namespace mrpt_sgraphs
