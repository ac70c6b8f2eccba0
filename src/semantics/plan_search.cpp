// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plan_search.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace mrpt_sgraphs {
namespace {

/// A surface that is farther than this from the known ones is not near.
constexpr double kNear_m = 0.3;
constexpr float kFull = 255.0F;
/// Headings are so far apart that what lies a dozen metres away moves by a cell or two.
constexpr int kHeadings = 360;
/// A robot's place may lie in a cell that nothing is known of, between free ones.
constexpr int kStandingRoom = 3;
/// Of matches; more are no more ambiguous.
constexpr std::size_t kMost = 12;

float nearness(float distance_m) {
  return std::max(0.0F, 1.0F - distance_m / static_cast<float>(kNear_m));
}

double headingOf(int k) { return 2.0 * M_PI * k / kHeadings; }

double headingOf(const Eigen::Isometry2d& T) { return std::atan2(T.linear()(1, 0), T.linear()(0, 0)); }

double turnBetween(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, 2.0 * M_PI));
}

Eigen::Isometry2d poseAt(const Eigen::Vector2d& place, double heading_rad) {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.linear() = Eigen::Rotation2Dd(heading_rad).toRotationMatrix();
  T.translation() = place;
  return T;
}

}  // namespace

/// A heading and a square of 2^level cells for the origin of the plan.
struct PlanSearch::Node {
  double bound = 0.0;
  int heading = 0;
  Cell corner;
  int level = 0;

  /// The best comes first, and of equal ones always the same.
  friend bool operator<(const Node& a, const Node& b) {
    return std::tie(a.bound, b.heading, b.corner.row, b.corner.column) <
           std::tie(b.bound, a.heading, a.corner.row, a.corner.column);
  }

  Eigen::Vector2d middle(double cell_m) const {
    const double half = 0.5 * (1 << level);
    return {(corner.column + half) * cell_m, (corner.row + half) * cell_m};
  }
};

PlanSearch::PlanSearch(const StoreyPlan& known) : known_(known) {
  CellGrid<uint8_t> finest(known.box(), 0);
  finest.forEach([&](Cell cell) {
    finest[cell] = static_cast<uint8_t>(kFull * nearness(known.distanceAt(cell)));
  });
  nearness_.push_back(std::move(finest));
  for (int level = 1; level < kLevels; ++level) {
    const int step = 1 << (level - 1);
    const CellGrid<uint8_t>& below = nearness_.back();
    const CellBox& box = below.box();
    // squares that begin before the plan reach into it
    CellGrid<uint8_t> grid(CellBox{{box.min.column - step, box.min.row - step}, box.max}, 0);
    grid.forEach([&](Cell c) {
      grid[c] = std::max({below.valueOr(c, 0), below.valueOr({c.column + step, c.row}, 0),
                          below.valueOr({c.column, c.row + step}, 0),
                          below.valueOr({c.column + step, c.row + step}, 0)});
    });
    nearness_.push_back(std::move(grid));
  }
}

double PlanSearch::bound(const std::vector<Cell>& cells, const Node& node) const {
  const CellGrid<uint8_t>& grid = nearness_[static_cast<std::size_t>(node.level)];
  int sum = 0;
  for (const Cell cell : cells) {
    sum += grid.valueOr({cell.column + node.corner.column, cell.row + node.corner.row}, 0);
  }
  return sum / (static_cast<double>(kFull) * static_cast<double>(cells.size()));
}

double PlanSearch::score(const std::vector<Eigen::Vector2d>& surfaces,
                         const Eigen::Isometry2d& T_known_plan) const {
  double sum = 0.0;
  for (const Eigen::Vector2d& surface : surfaces) {
    sum += static_cast<double>(nearness(known_.distanceAt(T_known_plan * surface)));
  }
  return sum / static_cast<double>(surfaces.size());
}

bool PlanSearch::standsFree(Cell cell) const {
  for (int row = -kStandingRoom; row <= kStandingRoom; ++row) {
    for (int column = -kStandingRoom; column <= kStandingRoom; ++column) {
      if (known_.hasRoom({cell.column + column, cell.row + row})) return true;
    }
  }
  return false;
}

std::vector<PlanMatch> PlanSearch::find(const std::vector<Eigen::Vector2d>& surfaces,
                                        double min_score, double spread,
                                        const PlanWindow& window) const {
  if (surfaces.empty() || known_.surfaces().empty()) return {};
  const double cell_m = known_.cell_m();
  CellBox box = known_.box();
  if (window.reach_m > 0.0) {
    const Cell centre = cellAt(window.T_known_plan.translation(), cell_m);
    box = box.shared(CellBox{centre, centre}.grown(static_cast<int>(window.reach_m / cell_m) + 1));
  }

  std::vector<std::vector<Cell>> turned(kHeadings);
  std::priority_queue<Node> open;
  for (int heading = 0; heading < kHeadings; ++heading) {
    if (window.reach_m > 0.0 &&
        turnBetween(headingOf(heading), headingOf(window.T_known_plan)) > window.reach_rad) {
      continue;
    }
    const Eigen::Rotation2Dd R(headingOf(heading));
    // the origin comes to lie in the middle of its cell
    for (const Eigen::Vector2d& surface : surfaces) {
      turned[static_cast<std::size_t>(heading)].push_back(
          cellAt(R * surface + Eigen::Vector2d::Constant(0.5 * cell_m), cell_m));
    }
    constexpr int kStep = 1 << (kLevels - 1);
    for (int row = box.min.row; row <= box.max.row; row += kStep) {
      for (int column = box.min.column; column <= box.max.column; column += kStep) {
        Node node{0.0, heading, {column, row}, kLevels - 1};
        node.bound = bound(turned[static_cast<std::size_t>(heading)], node);
        if (node.bound >= min_score) open.push(node);
      }
    }
  }

  std::vector<PlanMatch> matches;
  const auto isTaken = [&](const Node& node) {
    const double reach_m = kDistinct_m - cell_m * (1 << node.level) * M_SQRT1_2;
    return std::any_of(matches.begin(), matches.end(), [&](const PlanMatch& match) {
      return turnBetween(headingOf(node.heading), headingOf(match.T_known_plan)) < kDistinct_rad &&
             (match.T_known_plan.translation() - node.middle(cell_m)).norm() < reach_m;
    });
  };
  while (!open.empty() && matches.size() < kMost) {
    const Node node = open.top();
    open.pop();
    if (!matches.empty() && node.bound < matches.front().score - spread) break;
    if (isTaken(node)) continue;
    if (node.level == 0) {
      if (!box.contains(node.corner) || !standsFree(node.corner)) continue;
      matches.push_back({poseAt(node.middle(cell_m), headingOf(node.heading)), node.bound});
      continue;
    }
    const int half = 1 << (node.level - 1);
    for (const int row : {0, half}) {
      for (const int column : {0, half}) {
        Node part{0.0, node.heading, {node.corner.column + column, node.corner.row + row},
                  node.level - 1};
        part.bound = bound(turned[static_cast<std::size_t>(node.heading)], part);
        if (part.bound >= min_score) open.push(part);
      }
    }
  }
  return matches;
}

PlanMatch PlanSearch::refined(const std::vector<Eigen::Vector2d>& surfaces, PlanMatch match) const {
  match.score = score(surfaces, match.T_known_plan);
  constexpr double kLever_m = 6.0;  // most of the surfaces are nearer
  for (double step_m = known_.cell_m(); step_m > 0.2 * known_.cell_m(); step_m *= 0.5) {
    for (bool better = true; better;) {
      better = false;
      for (int direction = 0; direction < 6; ++direction) {
        const double sign = direction % 2 == 0 ? step_m : -step_m;
        Eigen::Isometry2d T = match.T_known_plan;
        if (direction < 4) {
          T.translation()[direction / 2] += sign;
        } else {
          T.linear() = Eigen::Rotation2Dd(sign / kLever_m).toRotationMatrix() * T.linear();
        }
        const double value = score(surfaces, T);
        if (value <= match.score + 1e-9) continue;
        match = {T, value};
        better = true;
      }
    }
  }
  return match;
}

std::vector<Eigen::Vector2d> spreadOut(const std::vector<Eigen::Vector2d>& points,
                                       std::size_t most) {
  std::vector<Eigen::Vector2d> kept = points;
  for (double edge_m = 0.2; kept.size() > most; edge_m *= M_SQRT2) {
    kept.clear();
    CellSet seen;
    for (const Eigen::Vector2d& point : points) {
      const Cell cell = cellAt(point, edge_m);
      if (seen.contains(cell)) continue;
      seen.add(cell);
      kept.push_back(point);
    }
  }
  return kept;
}

}  // namespace mrpt_sgraphs
