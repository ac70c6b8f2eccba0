// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/lidar_model.h"
#include "sim/random.h"
#include "sim/scene.h"
#include "sim/seen_walls.h"
#include "sim/trajectory.h"

namespace mrpt_sgraphs::sim {

/// One echo. The point is in the lidar's frame at the moment of its firing.
struct LidarReturn {
  Eigen::Vector3f point_lidar = Eigen::Vector3f::Zero();
  float range_m = 0.0F;
  float intensity = 0.0F;  ///< 0..100, reflectivity times the cosine of incidence.
  uint32_t offset_ns = 0;  ///< Of the firing, from the start of the sweep.
  uint16_t ring = 0;
  uint16_t column = 0;
};

/// A sweep, in the order of firing.
struct LidarScan {
  int64_t start_ns = 0;  ///< Since the start of the run.
  int64_t period_ns = 0;
  std::vector<LidarReturn> returns;
};

/// A spinning lidar on a walking robot in a building: every column leaves from where the lidar is
/// at that moment.
class Lidar {
 public:
  /// Keeps references to scene and trajectory.
  Lidar(const LidarModel& model, const Pose& T_base_lidar, const Scene& scene,
        const Trajectory& trajectory, uint64_t seed);

  /// The `index`-th sweep from the start of the run. Noise depends on the sweeps before.
  /// @param seen  Where not null, is told of every echo of a wall.
  LidarScan scan(int64_t index, SeenWalls* seen = nullptr);

  /// The start of a sweep [ns]; rates need not divide a second.
  int64_t startOf_ns(int64_t index) const;

 private:
  void fireColumn(int column, LidarScan& scan, SeenWalls* seen);

  LidarModel model_;
  Pose T_base_lidar_;
  const Scene& scene_;
  const Trajectory& trajectory_;
  Random random_;
  std::vector<Eigen::Vector2d> beams_;  ///< Cosine and sine of each ring's elevation.
};

}  // namespace mrpt_sgraphs::sim
