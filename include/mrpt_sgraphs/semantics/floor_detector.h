// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <utility>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/semantics/floor_detector_config.h"

namespace mrpt_sgraphs {

/// A level of the building, and what belongs to it.
struct DetectedFloor {
  FloorId id;
  std::vector<KeyframeId> keyframes;
  std::vector<WallId> walls;
};

/// Stairs or a ramp: what the robot went from one level to another by. Belongs to neither.
struct DetectedConnection {
  FloorId from;  ///< The level that it was left by the first time.
  FloorId to;
  std::vector<KeyframeId> keyframes;  ///< On it.
};

struct FloorDetection {
  double stamp_s = 0.0;  ///< Of the newest keyframe that it knows of.
  std::vector<DetectedFloor> floors;
  std::vector<DetectedConnection> connections;
  std::vector<std::pair<FloorId, FloorId>>
      same;  ///< Nodes that are one level, the older one first.
};

/// What belongs to which level, from heights and the way that the robot has gone.
FloorDetection detectFloors(const GraphSnapshot& graph, const FloorDetectorConfig& config);

}  // namespace mrpt_sgraphs
