// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/room_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kCell_m = 0.1;
/// Half the width of a quadruped (0.25 m) and what rounding and sway need.
constexpr double kMinClearance_m = 0.42;
/// Nearer than this a way costs more, so that it leads along the middle where there is room.
constexpr double kComfortable_m = 1.0;
constexpr double kDiscomfort = 2.0;  ///< Factor on length per metre that comfort is missed by.
/// A round keeps this part of the room's half width from the walls, and no more than the maximum.
constexpr double kInsetFraction = 0.7;
constexpr double kMaxInset_m = 2.6;
constexpr double kMinSpacing_m = 1.0;  ///< Of the places of a round.

double discomfort(double clearance_m) {
  return 1.0 + kDiscomfort * std::max(0.0, kComfortable_m - clearance_m);
}

}  // namespace

RoomPlanner::RoomPlanner(const FloorPlan& plan, const Polygon2& outline) : outline_(outline) {
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector2d& corner : outline) extent.extend(corner);
  origin_ = extent.min();
  columns_ = static_cast<int>(std::ceil(extent.sizes().x() / kCell_m)) + 1;
  rows_ = static_cast<int>(std::ceil(extent.sizes().y() / kCell_m)) + 1;
  clearance_m_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
  for (size_t cell = 0; cell < clearance_m_.size(); ++cell) {
    const Eigen::Vector2d centre = centreOf(cell);
    clearance_m_[cell] = contains(outline, centre) ? plan.clearance(centre) : -1.0;
  }
}

size_t RoomPlanner::cellOf(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d offset = (point - origin_) / kCell_m;
  const int column = std::clamp(static_cast<int>(std::lround(offset.x())), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(std::lround(offset.y())), 0, rows_ - 1);
  return static_cast<size_t>(row * columns_ + column);
}

Eigen::Vector2d RoomPlanner::centreOf(size_t cell) const {
  const int index = static_cast<int>(cell);
  return origin_ + kCell_m * Eigen::Vector2d(index % columns_, index / columns_);
}

bool RoomPlanner::isFree(size_t cell) const { return clearance_m_[cell] >= kMinClearance_m; }

std::optional<Eigen::Vector2d> RoomPlanner::nearestFree(const Eigen::Vector2d& point) const {
  std::optional<Eigen::Vector2d> nearest;
  for (size_t cell = 0; cell < clearance_m_.size(); ++cell) {
    if (!isFree(cell)) continue;
    const Eigen::Vector2d centre = centreOf(cell);
    if (!nearest || (centre - point).norm() < (*nearest - point).norm()) nearest = centre;
  }
  return nearest;
}

Eigen::Vector2d RoomPlanner::middle() const {
  const auto widest = std::max_element(clearance_m_.begin(), clearance_m_.end());
  return centreOf(static_cast<size_t>(widest - clearance_m_.begin()));
}

bool RoomPlanner::sees(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.5 * kCell_m))));
  for (int k = 0; k <= steps; ++k) {
    if (!isFree(cellOf(a + (b - a) * k / steps))) return false;
  }
  return true;
}

std::vector<size_t> RoomPlanner::search(size_t start, size_t goal) const {
  const double kUnreached = std::numeric_limits<double>::infinity();
  std::vector<double> cost(clearance_m_.size(), kUnreached);
  std::vector<size_t> from(clearance_m_.size(), start);
  using Entry = std::pair<double, size_t>;  // estimate of the whole way, cell
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[start] = 0.0;
  open.emplace(0.0, start);
  while (!open.empty()) {
    const size_t cell = open.top().second;
    open.pop();
    if (cell == goal) break;
    const int column = static_cast<int>(cell) % columns_;
    const int row = static_cast<int>(cell) / columns_;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = column + dx;
        const int y = row + dy;
        if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
        const size_t next = static_cast<size_t>(y * columns_ + x);
        if (!isFree(next)) continue;
        const double step = kCell_m * std::hypot(dx, dy) * discomfort(clearance_m_[next]);
        if (cost[cell] + step >= cost[next]) continue;
        cost[next] = cost[cell] + step;
        from[next] = cell;
        open.emplace(cost[next] + (centreOf(next) - centreOf(goal)).norm(), next);
      }
    }
  }
  if (cost[goal] == kUnreached) return {};
  std::vector<size_t> way{goal};
  while (way.back() != start) way.push_back(from[way.back()]);
  std::reverse(way.begin(), way.end());
  return way;
}

Polygon2 RoomPlanner::taut(const Polygon2& points) const {
  Polygon2 corners{points.front()};
  size_t at = 0;
  while (at + 1 < points.size()) {
    size_t next = points.size() - 1;
    while (next > at + 1 && !sees(points[at], points[next])) --next;
    corners.push_back(points[next]);
    at = next;
  }
  return corners;
}

std::optional<Polygon2> RoomPlanner::path(const Eigen::Vector2d& from,
                                          const Eigen::Vector2d& to) const {
  const std::optional<Eigen::Vector2d> start = nearestFree(from);
  const std::optional<Eigen::Vector2d> goal = nearestFree(to);
  if (!start || !goal) return std::nullopt;
  if (sees(from, to)) return Polygon2{to};
  const std::vector<size_t> cells = search(cellOf(*start), cellOf(*goal));
  if (cells.empty()) return std::nullopt;
  Polygon2 points{from};
  constexpr size_t kStride = 3;  // every third cell is near enough for pulling taut
  for (size_t k = kStride; k + kStride < cells.size(); k += kStride) {
    points.push_back(centreOf(cells[k]));
  }
  points.push_back(to);
  const Polygon2 corners = taut(points);
  return Polygon2(corners.begin() + 1, corners.end());
}

Polygon2 RoomPlanner::round(RoomKind kind) const {
  const double half_width_m = distanceToOutline(outline_, middle());
  const double inset_m = kind == RoomKind::kCorridor
                             ? half_width_m
                             : std::min(kMaxInset_m, kInsetFraction * half_width_m);
  Polygon2 places;
  for (size_t k = 0; k < outline_.size(); ++k) {
    const Eigen::Vector2d& corner = nextCorner(outline_, k);
    const Eigen::Vector2d before = (corner - outline_[k]).normalized();
    const Eigen::Vector2d after = (nextCorner(outline_, k + 1) - corner).normalized();
    if (cross(before, after) <= 0.0) continue;  // a corner that juts into the room
    const Eigen::Vector2d inward = leftOf(before) + leftOf(after);
    const auto place = nearestFree(corner + inset_m * inward / (0.5 * inward.squaredNorm()));
    if (!place) continue;
    const bool crowded = std::any_of(places.begin(), places.end(), [&](const auto& other) {
      return (other - *place).norm() < kMinSpacing_m;
    });
    if (!crowded) places.push_back(*place);
  }
  return places;
}

}  // namespace mrpt_sgraphs::sim
