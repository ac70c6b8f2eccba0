// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs::sim {

Simulation::Simulation(const Building& building, const SimulationConfig& config)
    : building_(turned(building, config.turn_rad)),
      config_(config),
      scene_(building_),
      trajectory_(walkTour(building, config.robot, MotionLimits{}, config.turn_rad)),
      T_base_lidar_(config.robot.T_base_lidar(config.lidar.mount_pitch_deg * M_PI / 180.0)),
      end_ns_(std::llround(1e9 * std::min(config.max_duration_s, trajectory_.duration_s()))),
      lidar_(config.lidar, T_base_lidar_, scene_, trajectory_, config.seed),
      imu_(trajectory_, config.seed),
      odometry_(trajectory_, config.seed),
      seen_walls_(building_) {
  while (lidar_.startOf_ns(scan_count_ + 1) <= end_ns_) ++scan_count_;
}

void Simulation::run(const MeasurementSink& sink) {
  constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
  int64_t imu_index = 0;
  int64_t odometry_index = 0;
  int64_t scan_index = 0;
  while (true) {
    const int64_t imu_ns = imu_index * Imu::kPeriod_ns;
    const int64_t odometry_ns = odometry_index * Odometry::kPeriod_ns;
    const int64_t scan_ns = scan_index < scan_count_ ? lidar_.startOf_ns(scan_index + 1) : kNever;
    const int64_t next_ns = std::min({imu_ns, odometry_ns, scan_ns});
    if (next_ns > end_ns_) return;
    if (next_ns == imu_ns) {
      sink.imu(imu_.sample(imu_index++));
    } else if (next_ns == odometry_ns) {
      sink.odometry(odometry_.next());
      ++odometry_index;
    } else {
      sink.scan(lidar_.scan(scan_index++, &seen_walls_));
    }
  }
}

}  // namespace mrpt_sgraphs::sim
