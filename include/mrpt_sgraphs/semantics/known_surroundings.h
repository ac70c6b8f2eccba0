// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/frontend/registration.h"
#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// What of a saved map a scan is registered against.
struct SurroundingsConfig {
  int keyframes = 12;      ///< The nearest ones that have clouds.
  double radius_m = 15.0;  ///< Of walls where those have seen nothing.
  VoxelMapConfig map;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("submap_keyframes", self.keyframes, 1, 1000);
    field("wall_radius_m", self.radius_m, 1.0, 1000.0);
    VoxelMapConfig::fields(self.map, field);
  }
};

/// The map around a place, to register scans with: the clouds of the nearest keyframes of that level,
/// and the walls and the ground of the graph where clouds are gone. Frame: `map`.
/// @param place_map  Of the sensor [m].
VoxelMap surroundingsOf(const GraphSnapshot& map, const Eigen::Vector3d& place_map,
                        const SurroundingsConfig& config);

/// The keyframe with a cloud that stands nearest to a place, on a level with it; of none the nearest
/// at all. Null for a map without keyframes.
const KeyframeNode* nearestKeyframe(const GraphSnapshot& map, const Eigen::Vector3d& place_map);

/// Of a cloud in the base frame: not so many that it takes long, and from all over.
std::vector<ScanPoint> registrationPoints(const Cloud& cloud);

}  // namespace mrpt_sgraphs
