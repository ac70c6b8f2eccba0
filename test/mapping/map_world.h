// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <random>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/occupancy_map.h"
#include "support/flat_world.h"

/// Keyframes that have seen a world, for the maps that are made of them.
namespace mrpt_sgraphs::test {

inline Pose at(double x, double y, double z, double yaw_rad = 0.0) {
  return expPose((Tangent() << x, y, z, 0.0, 0.0, yaw_rad).finished());
}

inline FlatWorld roomOf6by4() { return FlatWorld::box({0, 0, 0}, {6, 4, 2.6}); }

/// What a lidar sees, without noise unless told otherwise.
inline Cloud::ConstPtr cloudOf(const FlatWorld& world, const Pose& T_world_sensor,
                               double sigma_m = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  return Cloud::ConstPtr(new Cloud(
      scanOf(world, Pattern::spinning(32, 900, -0.6, 0.6), T_world_sensor, sigma_m, &random)));
}

/// A keyframe that was at one pose, and is believed to be at it.
inline KeyframeNode keyframeAt(uint64_t id, const FlatWorld& world, const Pose& T_world_base,
                               double sigma_m = 0.0) {
  KeyframeNode keyframe;
  keyframe.id = KeyframeId{id};
  keyframe.T_map_base = T_world_base;
  keyframe.cloud = cloudOf(world, T_world_base, sigma_m, static_cast<unsigned>(id) + 1U);
  return keyframe;
}

/// A walk along the room and back.
inline GraphSnapshot walkThrough(const FlatWorld& world, int keyframes, double sigma_m = 0.0) {
  GraphSnapshot graph;
  for (int k = 0; k < keyframes; ++k) {
    const double way = 4.0 * k / std::max(1, keyframes - 1);
    graph.keyframes.push_back(keyframeAt(static_cast<uint64_t>(k), world,
                                         at(1.0 + way, 1.5 + 0.25 * way, 0.7, 0.3 * k), sigma_m));
  }
  return graph;
}

/// Every voxel that is known, and whether it is occupied.
inline std::map<Voxel, bool> knownIn(const OccupancyMap& map) {
  std::map<Voxel, bool> known;
  map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    EXPECT_TRUE(known.emplace(voxel, is_occupied).second) << "one voxel twice";
    EXPECT_EQ(map.evidenceAt(voxel) > 0, is_occupied);
  });
  return known;
}

inline std::map<Voxel, int> evidenceIn(const OccupancyMap& map) {
  std::map<Voxel, int> evidence;
  map.forEachKnown([&](const Voxel& voxel, bool) { evidence[voxel] = map.evidenceAt(voxel); });
  return evidence;
}

}  // namespace mrpt_sgraphs::test
