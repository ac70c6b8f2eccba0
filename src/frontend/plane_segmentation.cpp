// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/frontend/plane_segmentation.h"

namespace mrpt_sgraphs {

std::vector<PlaneSegment> segmentPlanes(const GatheredPoints&, const PlaneSegmentationConfig&) {
  return {};
}

ObservedPlanesConstPtr observedPlanes(const std::vector<PlaneSegment>& segments) {
  return std::make_shared<const ObservedPlanes>(segments.begin(), segments.end());
}

}  // namespace mrpt_sgraphs
