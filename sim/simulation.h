// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "sim/imu.h"
#include "sim/lidar.h"
#include "sim/odometry.h"
#include "sim/robot.h"
#include "sim/scene.h"
#include "sim/seen_walls.h"
#include "sim/trajectory.h"

namespace mrpt_sgraphs::sim {

/// When runs start unless told otherwise, in seconds since 1970: a round number that is far from
/// zero, as real stamps are.
constexpr int64_t kStartOfRun_s = 1'700'000'000;

struct SimulationConfig {
  LidarModel lidar;
  Robot robot;
  uint64_t seed = 1;
  double turn_rad = 0.0;  ///< Of the building and the walk in it about the origin: see walkTour.
  int64_t start_s = kStartOfRun_s;  ///< By the robot's clock, since 1970.
  double max_duration_s = std::numeric_limits<double>::infinity();  ///< Cuts the tour short.
};

/// Receives measurements in the order in which drivers would publish them: a scan at its end.
struct MeasurementSink {
  std::function<void(const ImuSample&)> imu;
  std::function<void(const OdometrySample&)> odometry;
  std::function<void(const LidarScan&)> scan;
};

/// A robot walks the tour of a building and measures. Equal arguments give equal measurements.
class Simulation {
 public:
  /// @param building  Before it is turned by config.turn_rad.
  /// @throws std::invalid_argument if the tour cannot be walked.
  Simulation(const Building& building, const SimulationConfig& config);
  Simulation(const Simulation&) = delete;  // the sensors refer to its trajectory
  Simulation& operator=(const Simulation&) = delete;

  /// Measures the whole run; once.
  void run(const MeasurementSink& sink);

  const Building& building() const { return building_; }
  const SimulationConfig& config() const { return config_; }
  const SeenWalls& seenWalls() const { return seen_walls_; }  ///< In as much as was run.
  const Trajectory& trajectory() const { return trajectory_; }
  const Pose& T_base_lidar() const { return T_base_lidar_; }
  double duration_s() const { return 1e-9 * static_cast<double>(end_ns_); }
  int64_t scanCount() const { return scan_count_; }
  int64_t scanStart_ns(int64_t index) const { return lidar_.startOf_ns(index); }

 private:
  Building building_;
  SimulationConfig config_;
  Scene scene_;
  Trajectory trajectory_;
  Pose T_base_lidar_;
  int64_t end_ns_;
  Lidar lidar_;
  Imu imu_;
  Odometry odometry_;
  SeenWalls seen_walls_;
  int64_t scan_count_ = 0;  ///< Whole sweeps only.
};

}  // namespace mrpt_sgraphs::sim
