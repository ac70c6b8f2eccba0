// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/plane_observer.h"

#include <cstddef>

namespace mrpt_sgraphs {

PlaneObserver::PlaneObserver(const PlaneSegmentationConfig& config)
    : config_(config), gatherer_(static_cast<std::size_t>(config.gathered_points)) {}

void PlaneObserver::addScan(const Cloud::ConstPtr& deskewed, const Pose& T_odom_base,
                            bool registered) {
  if (!registered) return reset();
  gatherer_.add(deskewed, T_odom_base);
  has_scan_ = true;
}

ObservedPlanesConstPtr PlaneObserver::take() {
  if (!has_scan_) return nullptr;
  has_scan_ = false;
  return observedPlanes(segmentPlanes(gatherer_.take(), config_));
}

void PlaneObserver::reset() {
  gatherer_.reset();
  has_scan_ = false;
}

}  // namespace mrpt_sgraphs
