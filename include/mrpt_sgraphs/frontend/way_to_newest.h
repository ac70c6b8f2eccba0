// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/surface_sighting.h"

namespace mrpt_sgraphs {

/// How well the newest keyframe is known from each of the others, and how far the robot has gone.
class WayToNewest {
 public:
  /// To be called after a keyframe or a loop was added.
  void update(const LayeredGraph& graph);

  /// Covariance of the newest keyframe's pose, right perturbation, relative to that one of the
  /// keyframes that sees it best; relative to the first keyframe where there is none.
  const Matrix6& uncertaintyFrom(const std::vector<SurfaceSighting>& sightings,
                                 const LayeredGraph& graph) const;

  KeyframeId newest() const { return newest_; }
  double way_m() const { return way_m_; }  ///< By odometry, from the first keyframe.

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("uncertainty", uncertainty_);
    a("spread_m2", spread_m2_);
    a("newest", newest_);
    a("T_odom_newest", T_odom_newest_);
    a("way_m", way_m_);
  }

 private:
  std::vector<Matrix6> uncertainty_;  ///< By the keyframe's place.
  std::vector<double> spread_m2_;     ///< Of them.
  KeyframeId newest_;
  Pose T_odom_newest_ = Pose::Identity();
  double way_m_ = 0.0;
};

}  // namespace mrpt_sgraphs
