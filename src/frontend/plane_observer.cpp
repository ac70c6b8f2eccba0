// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/plane_observer.h"

#include <cstddef>

namespace mrpt_sgraphs {

PlaneObserver::PlaneObserver(const PlaneSegmentationConfig& config)
    : config_(config), gatherer_(static_cast<std::size_t>(config.gathered_points)) {}

void PlaneObserver::addScan(const Cloud::ConstPtr& deskewed, const Pose& T_odom_base,
                            bool registered) {
  if (!registered) {
    gatherer_.reset();
  } else if (isOfOneMoment(*deskewed)) {
    gatherer_.add(deskewed, T_odom_base);
  }
}

ObservedPlanesConstPtr PlaneObserver::take() {
  if (gatherer_.empty()) return nullptr;
  return observedPlanes(segmentPlanes(gatherer_.take(), config_));
}

}  // namespace mrpt_sgraphs
