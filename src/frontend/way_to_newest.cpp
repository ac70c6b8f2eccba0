// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/way_to_newest.h"

#include "mrpt_sgraphs/graph/uncertainty.h"

namespace mrpt_sgraphs {

void WayToNewest::update(const LayeredGraph& graph) {
  const GraphSnapshotConstPtr snapshot = graph.snapshot();
  uncertainty_ = uncertaintyToNewest(*snapshot);
  constexpr double kLever_m = 10.0;  // across a room or along a wall
  spread_m2_.clear();
  for (const Matrix6& covariance : uncertainty_) {
    spread_m2_.push_back(covariance.topLeftCorner<3, 3>().trace() +
                         kLever_m * kLever_m * covariance.bottomRightCorner<3, 3>().trace());
  }
  const KeyframeNode& newest = snapshot->keyframes.back();
  if (snapshot->keyframes.size() > 1 && newest.id != newest_) {
    way_m_ += (newest.T_odom_base.translation() - T_odom_newest_.translation()).norm();
  }
  T_odom_newest_ = newest.T_odom_base;
  newest_ = newest.id;
}

const Matrix6& WayToNewest::uncertaintyFrom(const std::vector<SurfaceSighting>& sightings,
                                            const LayeredGraph& graph) const {
  std::size_t best = 0;
  bool found = false;
  for (const SurfaceSighting& sighting : sightings) {
    const std::size_t place = graph.handle(sighting.keyframe).slot;
    if (!found || spread_m2_[place] < spread_m2_[best]) best = place;
    found = true;
  }
  return uncertainty_[best];
}

}  // namespace mrpt_sgraphs
