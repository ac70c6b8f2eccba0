// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "storey_plan.h"

namespace mrpt_sgraphs {

/// A place in a plan that looks right.
struct PlanMatch {
  Eigen::Isometry2d T_known_plan = Eigen::Isometry2d::Identity();
  double score = 0.0;  ///< 0 to 1: how near the surfaces are to the known ones.
};

/// Which part of all places is looked at.
struct PlanWindow {
  Eigen::Isometry2d T_known_plan = Eigen::Isometry2d::Identity();
  double reach_m = 0.0;  ///< Around it; zero or less: everywhere.
  double reach_rad = 0.0;
};

/// Where a plan lies on a larger one: every place and heading is looked at, by branch and bound
/// (after Olson, "Real-Time Correlative Scan Matching", ICRA 2009, and Hess et al., "Real-Time Loop
/// Closure in 2D LIDAR SLAM", ICRA 2016), so that what is not found is not there. Unlike theirs it
/// goes on to all other places that are nearly as good.
class PlanSearch {
 public:
  explicit PlanSearch(const StoreyPlan& known);

  /// @param surfaces  Of the plan to be found, about its origin, which has to come to lie where the
  ///                  known plan has free space: a robot stands there.
  /// @param spread    Matches are found down to this much below the best score.
  /// @return Places that are at least kDistinct_m or kDistinct_rad apart, the best first; not refined.
  std::vector<PlanMatch> find(const std::vector<Eigen::Vector2d>& surfaces, double min_score,
                              double spread, const PlanWindow& window) const;

  /// The best score near a match. Cells are all that plans know: a scan knows the place better.
  PlanMatch refined(const std::vector<Eigen::Vector2d>& surfaces, PlanMatch match) const;

  static constexpr double kDistinct_m = 1.0;
  static constexpr double kDistinct_rad = 0.26;

 private:
  static constexpr int kLevels = 5;
  struct Node;

  double bound(const std::vector<Cell>& cells, const Node& node) const;
  double score(const std::vector<Eigen::Vector2d>& surfaces,
               const Eigen::Isometry2d& T_known_plan) const;
  bool standsFree(Cell cell) const;

  const StoreyPlan& known_;
  /// For every cell the greatest nearness, 0 to 255, in the square of 2^level cells that begins there.
  std::vector<CellGrid<uint8_t>> nearness_;
};

/// So few points that all places can be looked at, and from all over.
std::vector<Eigen::Vector2d> spreadOut(const std::vector<Eigen::Vector2d>& points, std::size_t most);

}  // namespace mrpt_sgraphs
