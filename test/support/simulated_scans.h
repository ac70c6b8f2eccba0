// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/frontend/motion_buffers.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/frontend/raw_cloud.h"
#include "mrpt_sgraphs/io/tum.h"
#include "sim/point_encoding.h"
#include "sim/sim_support.h"
#include "sim/simulation.h"

/// What the simulator measures, in the types of the pipeline and in memory: no bag, no ROS.
namespace mrpt_sgraphs::test {

/// A driver's cloud that owns its bytes.
struct OwnedRawCloud {
  RawCloud header;  ///< Without `data`: view() has it.
  std::vector<std::uint8_t> bytes;

  RawCloud view() const {
    RawCloud raw = header;
    raw.data = bytes.data();
    raw.size = bytes.size();
    return raw;
  }
};

inline double stampOf(std::int64_t time_ns) {
  return static_cast<double>(sim::kStartOfRun_s) + 1e-9 * static_cast<double>(time_ns);
}

/// A sweep as an ideal prefilter would hand it on: all echoes, base frame, times from the stamp on.
inline Cloud::Ptr cloudOf(const sim::LidarScan& scan, const Pose& T_base_lidar) {
  Cloud::Ptr cloud(new Cloud);
  cloud->header.stamp = toPclStamp(stampOf(scan.start_ns));
  cloud->header.frame_id = "base_link";
  cloud->sensor_origin_.head<3>() = T_base_lidar.translation().cast<float>();
  for (const sim::LidarReturn& echo : scan.returns) {
    Point point;
    point.getVector3fMap() = (T_base_lidar * echo.point_lidar.cast<double>()).cast<float>();
    point.data[3] = 1.0F;
    point.intensity = echo.intensity;
    point.time = static_cast<float>(1e-9 * echo.offset_ns);
    point.ring = echo.ring;
    cloud->push_back(point);
  }
  return cloud;
}

/// The same sweep as its driver sends it.
inline OwnedRawCloud rawCloudOf(const sim::LidarScan& scan, const sim::LidarModel& model) {
  OwnedRawCloud raw;
  raw.header.stamp_s = stampOf(scan.start_ns);
  raw.header.frame_id = "lidar";
  sim::EncodedCloud encoded = sim::encode(scan, model, raw.header.stamp_s);
  for (const sim::EncodedCloud::Field& field : encoded.fields) {
    raw.header.fields.push_back(
        {field.name, field.offset, static_cast<RawCloud::Type>(field.datatype), 1});
  }
  raw.header.width = encoded.width;
  raw.header.height = encoded.height;
  raw.header.point_step = encoded.point_step;
  raw.header.row_step = encoded.width * encoded.point_step;
  raw.bytes = std::move(encoded.data);
  return raw;
}

/// The scan without its times, as many drivers send it.
inline Cloud::Ptr withoutTimes(const Cloud& cloud) {
  Cloud::Ptr result(new Cloud(cloud));
  for (Point& point : *result) point.time = 0.0F;
  return result;
}

/// A whole run of the simulator.
struct SimulatedRun {
  sim::LidarModel lidar;
  Pose T_base_lidar = Pose::Identity();
  std::vector<ImuSample> imu;
  std::vector<OdomSample> odom;
  std::vector<sim::LidarScan> scans;
  Trajectory truth;  ///< T_map_base at the stamp of each scan

  Cloud::Ptr cloud(std::size_t scan) const { return cloudOf(scans[scan], T_base_lidar); }
  OwnedRawCloud rawCloud(std::size_t scan) const { return rawCloudOf(scans[scan], lidar); }
};

/// @param turn_rad  Of the building and the walk in it about the origin.
inline SimulatedRun simulatedRun(const sim::Building& building, const std::string& sensor,
                                 double duration_s = std::numeric_limits<double>::infinity(),
                                 double turn_rad = 0.0) {
  sim::SimulationConfig config;
  config.turn_rad = turn_rad;
  config.lidar = sim::lidarNamed(sensor);
  config.robot = sim::robotNamed("legged");
  config.max_duration_s = duration_s;
  sim::Simulation simulation(building, config);

  SimulatedRun run;
  run.lidar = config.lidar;
  run.T_base_lidar = simulation.T_base_lidar();
  sim::MeasurementSink sink;
  sink.imu = [&](const sim::ImuSample& sample) {
    run.imu.push_back(
        {stampOf(sample.time_ns), sample.angular_velocity_base, sample.acceleration_base});
  };
  sink.odometry = [&](const sim::OdometrySample& sample) {
    run.odom.push_back({stampOf(sample.time_ns), sample.T_odom_base});
  };
  sink.scan = [&](const sim::LidarScan& scan) {
    run.scans.push_back(scan);
    run.truth.push_back({stampOf(scan.start_ns), simulation.trajectory().T_map_base(
                                                     1e-9 * static_cast<double>(scan.start_ns))});
  };
  simulation.run(sink);
  return run;
}

/// A robot that stands, or moves and turns steadily.
struct SteadyMotion {
  Eigen::Vector2d place_map{0.0, 0.0};  ///< [m] at the scan's stamp
  double yaw_rad = 0.0;
  Eigen::Vector2d velocity_map{0.0, 0.0};  ///< [m/s]
  double turning_rad_s = 0.0;
};

/// One sweep and where it was begun.
struct PlacedScan {
  Cloud::Ptr cloud;  ///< Base frame, distorted by the motion.
  Pose T_map_base = Pose::Identity();
};

/// A building in which scans are taken at will.
class ScanStage {
 public:
  ScanStage(const sim::Building& building, const sim::LidarModel& lidar)
      : scene_(building),
        lidar_(lidar),
        T_base_lidar_(sim::robotNamed("legged").T_base_lidar(0.0)) {}

  const Pose& T_base_lidar() const { return T_base_lidar_; }

  /// @param seed  Of the noise; the stamp is `seed` sweeps after the start of the run.
  PlacedScan scan(const SteadyMotion& motion, std::uint64_t seed = 1) const {
    // the spline is straight a few control points from its ends
    constexpr int kStates = 20;
    constexpr std::int64_t kSweep = 15;
    const double at_s = static_cast<double>(kSweep) / lidar_.rate_hz;
    std::vector<sim::MotionState> states;
    for (int k = 0; k < kStates; ++k) {
      const double t = k * sim::kMotionPeriod_s - at_s;
      const Eigen::Vector2d p = motion.place_map + t * motion.velocity_map;
      states.push_back({{p.x(), p.y(), 0.0}, motion.yaw_rad + t * motion.turning_rad_s, 0.0, 0.0});
    }
    const sim::Trajectory trajectory(states, sim::robotNamed("legged"));
    sim::Lidar lidar(lidar_, T_base_lidar_, scene_, trajectory, seed);
    sim::LidarScan sweep = lidar.scan(kSweep);
    sweep.start_ns = static_cast<std::int64_t>(seed) * sweep.period_ns;
    return {cloudOf(sweep, T_base_lidar_), trajectory.T_map_base(at_s)};
  }

 private:
  sim::Scene scene_;
  sim::LidarModel lidar_;
  Pose T_base_lidar_;
};

/// A sensor by name, with other noise.
inline sim::LidarModel lidarWithNoise(const std::string& name, double noise_m) {
  sim::LidarModel model = sim::lidarNamed(name);
  model.noise_m = noise_m;
  return model;
}

}  // namespace mrpt_sgraphs::test
