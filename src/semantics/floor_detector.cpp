// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/floor_detector.h"

namespace mrpt_sgraphs {

FloorDetection detectFloors(const GraphSnapshot& graph, const FloorDetectorConfig&) {
  FloorDetection detection;
  detection.stamp_s = graph.stamp_s;
  return detection;
}

}  // namespace mrpt_sgraphs
