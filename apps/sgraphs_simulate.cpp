// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "sim/atomic_file.h"
#include "sim/options.h"
#include "sim/point_encoding.h"
#include "sim/simulation.h"
#include "sim/truth.h"

namespace {

using namespace mrpt_sgraphs;

constexpr char kOdomFrame[] = "odom";
constexpr char kBaseFrame[] = "base_link";
constexpr char kLidarFrame[] = "lidar";
constexpr char kImuFrame[] = "imu_link";

/// The robot's clock.
struct Clock {
  int64_t start_s;

  ros::Time at(int64_t time_ns) const {
    constexpr int64_t kNsPerSecond = 1'000'000'000;
    return {static_cast<uint32_t>(start_s + time_ns / kNsPerSecond),
            static_cast<uint32_t>(time_ns % kNsPerSecond)};
  }
};

template <typename Message>
void toMessage(const Eigen::Vector3d& v, Message& message) {
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
}

geometry_msgs::Quaternion toMessage(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

geometry_msgs::TransformStamped transform(const Clock& clock, const char* frame, const char* child,
                                          const Pose& T) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = clock.at(0);
  message.header.frame_id = frame;
  message.child_frame_id = child;
  toMessage(T.translation(), message.transform.translation);
  message.transform.rotation = toMessage(T.linear());
  return message;
}

sensor_msgs::Imu toMessage(const Clock& clock, const sim::ImuSample& sample,
                           const sim::ImuNoise& noise) {
  sensor_msgs::Imu message;
  message.header.stamp = clock.at(sample.time_ns);
  message.header.frame_id = kImuFrame;
  message.orientation.w = 1.0;
  message.orientation_covariance[0] = -1.0;  // there is no orientation
  toMessage(sample.angular_velocity_base, message.angular_velocity);
  toMessage(sample.acceleration_base, message.linear_acceleration);
  for (size_t k = 0; k < 9; k += 4) {
    message.angular_velocity_covariance[k] = noise.gyro_rad_s * noise.gyro_rad_s;
    message.linear_acceleration_covariance[k] = noise.accelerometer_m_s2 * noise.accelerometer_m_s2;
  }
  return message;
}

nav_msgs::Odometry toMessage(const Clock& clock, const sim::OdometrySample& sample,
                             const sim::OdometryNoise& noise) {
  // What a driver would claim: position as good as its scale, heading as its bias and walk.
  constexpr double kVelocitySigma_m_s = 0.03;
  constexpr double kRateSigma_rad_s = 0.02;
  const double position_m = 0.01 + noise.scale * sample.distance_m;
  const double yaw_rad = 0.005 + noise.yaw_rate_bias_rad_s * 1e-9 * double(sample.time_ns) +
                         noise.yaw_walk_rad * std::sqrt(sample.distance_m);
  nav_msgs::Odometry message;
  message.header.stamp = clock.at(sample.time_ns);
  message.header.frame_id = kOdomFrame;
  message.child_frame_id = kBaseFrame;
  toMessage(sample.T_odom_base.translation(), message.pose.pose.position);
  message.pose.pose.orientation = toMessage(sample.T_odom_base.linear());
  toMessage(sample.velocity_base, message.twist.twist.linear);
  toMessage(sample.angular_velocity_base, message.twist.twist.angular);
  for (size_t k = 0; k < 3; ++k) {
    message.pose.covariance[7 * k] = position_m * position_m;
    message.twist.covariance[7 * k] = kVelocitySigma_m_s * kVelocitySigma_m_s;
    message.pose.covariance[7 * (k + 3)] = noise.tilt_rad * noise.tilt_rad;
    message.twist.covariance[7 * (k + 3)] = kRateSigma_rad_s * kRateSigma_rad_s;
  }
  message.pose.covariance[35] = yaw_rad * yaw_rad;
  return message;
}

sensor_msgs::PointCloud2 toMessage(const Clock& clock, const sim::LidarScan& scan,
                                   const sim::LidarModel& model) {
  sensor_msgs::PointCloud2 message;
  message.header.stamp = clock.at(scan.start_ns);
  message.header.frame_id = kLidarFrame;
  sim::EncodedCloud cloud = sim::encode(scan, model, message.header.stamp.toSec());
  for (const sim::EncodedCloud::Field& field : cloud.fields) {
    sensor_msgs::PointField described;
    described.name = field.name;
    described.offset = field.offset;
    described.datatype = field.datatype;
    described.count = 1;
    message.fields.push_back(described);
  }
  message.height = cloud.height;
  message.width = cloud.width;
  message.point_step = cloud.point_step;
  message.row_step = cloud.width * cloud.point_step;
  message.is_dense = true;  // as drivers say, who write zeros and no NaN
  message.data = std::move(cloud.data);
  return message;
}

/// Shows on a terminal, and only there, how far the run is.
class Progress {
 public:
  explicit Progress(double duration_s) : duration_s_(duration_s), shown_(isatty(STDERR_FILENO)) {}
  ~Progress() {
    if (shown_) std::fprintf(stderr, "\n");
  }
  void at(double time_s) const {
    if (shown_) std::fprintf(stderr, "\r%6.1f of %.1f s", time_s, duration_s_);
  }

 private:
  double duration_s_;
  bool shown_;
};

/// The fixed frames, latched as tf2's static broadcaster does.
void writeStaticTransforms(rosbag::Bag& bag, const Clock& clock,
                           const sim::Simulation& simulation) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {transform(clock, kBaseFrame, kLidarFrame, simulation.T_base_lidar()),
                           transform(clock, kBaseFrame, kImuFrame, Pose::Identity())};
  using Traits = ros::message_traits::MD5Sum<tf2_msgs::TFMessage>;
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::DataType<tf2_msgs::TFMessage>::value();
  (*header)["md5sum"] = Traits::value();
  (*header)["message_definition"] = ros::message_traits::Definition<tf2_msgs::TFMessage>::value();
  (*header)["latching"] = "1";
  bag.write("/tf_static", clock.at(0), transforms, header);
}

void writeBag(const std::string& path, sim::Simulation& simulation) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::LZ4);
  const Clock clock{simulation.config().start_s};
  writeStaticTransforms(bag, clock, simulation);
  const Progress progress(simulation.duration_s());
  const sim::LidarModel& model = simulation.config().lidar;
  sim::MeasurementSink sink;
  sink.imu = [&](const sim::ImuSample& sample) {
    bag.write("/imu", clock.at(sample.time_ns), toMessage(clock, sample, sim::ImuNoise{}));
  };
  sink.odometry = [&](const sim::OdometrySample& sample) {
    bag.write("/odom", clock.at(sample.time_ns), toMessage(clock, sample, sim::OdometryNoise{}));
  };
  sink.scan = [&](const sim::LidarScan& scan) {
    bag.write("/points", clock.at(scan.start_ns + scan.period_ns), toMessage(clock, scan, model));
    progress.at(1e-9 * static_cast<double>(scan.start_ns + scan.period_ns));
  };
  simulation.run(sink);
  bag.close();
}

int simulate(const sim::Options& options) {
  const sim::Building building =
      sim::withTours(sim::loadBuilding(options.building_file), options.tours);
  sim::Simulation simulation(building, options.simulation);
  if (simulation.scanCount() == 0) throw std::invalid_argument("--duration is less than a sweep");
  std::filesystem::create_directories(options.out_directory);
  sim::AtomicFile bag(std::filesystem::path(options.out_directory) / "run.bag");
  writeBag(bag.part(), simulation);
  sim::writeTruth(simulation, options.out_directory);
  bag.commit();
  return 0;
}

}  // namespace

/// Exit code 0: everything is written; 1: it is not; 2: the command line is wrong.
int main(int argc, char** argv) {
  sim::Options options;
  try {
    options = sim::parseOptions(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sgraphs_simulate: %s\nTry --help.\n", error.what());
    return 2;
  }
  if (options.help) {
    std::fputs(sim::usage().c_str(), stdout);
    return 0;
  }
  try {
    return simulate(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sgraphs_simulate: %s\n", error.what());
    return 1;
  }
}
