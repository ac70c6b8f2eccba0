// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes a bag of a robot that drives once round in a room, seen by a spinning LiDAR: small,
// without noise, and with the truth in it. The first argument is the file.
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

constexpr double kStart_s = 1000.0;
constexpr double kDuration_s = 14.0;
constexpr double kScan_s = 0.1;
constexpr double kRadius_m = 2.0;
constexpr double kTurn_rad_s = 2.0 * M_PI / 12.0;  // once round in twelve seconds
constexpr int kBeams = 16;
constexpr int kColumns = 180;
constexpr double kGravity_m_s2 = 9.80665;

using Boxes = std::vector<Eigen::AlignedBox3d>;

/// Seen from inside.
const Eigen::AlignedBox3d kRoom{Eigen::Vector3d(-6.0, -4.0, 0.0), Eigen::Vector3d(5.0, 4.5, 3.0)};
const Boxes kFurniture{{Eigen::Vector3d(-6.0, -4.0, 0.0), Eigen::Vector3d(-4.5, -2.0, 2.0)},
                       {Eigen::Vector3d(3.5, 2.0, 0.0), Eigen::Vector3d(4.0, 3.0, 3.0)},
                       {Eigen::Vector3d(-1.0, 4.0, 0.0), Eigen::Vector3d(1.5, 4.5, 1.0)}};

Eigen::Isometry3d T_base_lidar() {
  return Eigen::Translation3d(0.2, 0.0, 0.6) *
         Eigen::Isometry3d(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
}

Eigen::Isometry3d T_base_imu() {
  return Eigen::Isometry3d(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX()));
}

Eigen::Isometry3d T_room_base(double time_s) {
  const double angle = kTurn_rad_s * time_s;
  return Eigen::Translation3d(kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), 0.0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(angle + M_PI / 2.0, Eigen::Vector3d::UnitZ()));
}

/// Distances at which the ray enters and leaves the box; it misses if it leaves before it enters.
std::pair<double, double> crossing(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min() - from).array() / direction.array();
  const Eigen::Array3d b = (box.max() - from).array() / direction.array();
  return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
}

double rangeOf(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double range = crossing(kRoom, from, direction).second;
  for (const Eigen::AlignedBox3d& box : kFurniture) {
    const auto [enters, leaves] = crossing(box, from, direction);
    if (enters > 0.0 && enters < leaves) range = std::min(range, enters);
  }
  return range;
}

sensor_msgs::PointCloud2 scanAt(double start_s) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "lidar";
  cloud.header.stamp.fromSec(kStart_s + start_s);
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(
      5, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32, "z", 1,
      sensor_msgs::PointField::FLOAT32, "ring", 1, sensor_msgs::PointField::UINT16, "time", 1,
      sensor_msgs::PointField::FLOAT32);
  modifier.resize(kBeams * kColumns);
  sensor_msgs::PointCloud2Iterator<float> xyz(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint16_t> ring(cloud, "ring");
  sensor_msgs::PointCloud2Iterator<float> time(cloud, "time");
  for (int column = 0; column < kColumns; ++column) {
    const double tau_s = kScan_s * column / kColumns;
    const double azimuth = 2.0 * M_PI * column / kColumns;
    const Eigen::Isometry3d T_room_lidar = T_room_base(start_s + tau_s) * T_base_lidar();
    for (int beam = 0; beam < kBeams; ++beam, ++xyz, ++ring, ++time) {
      const double elevation = (2.0 * beam - kBeams + 1) * M_PI / 180.0;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const Eigen::Vector3d point =
          rangeOf(T_room_lidar.translation(), T_room_lidar.linear() * direction) * direction;
      for (int k = 0; k < 3; ++k) xyz[k] = static_cast<float>(point[k]);
      *ring = static_cast<std::uint16_t>(beam);
      *time = static_cast<float>(tau_s);
    }
  }
  return cloud;
}

sensor_msgs::Imu imuAt(double time_s) {
  sensor_msgs::Imu imu;
  imu.header.frame_id = "imu_link";
  imu.header.stamp.fromSec(kStart_s + time_s);
  const Eigen::Matrix3d R_imu_base = T_base_imu().linear().transpose();
  const Eigen::Vector3d turning = R_imu_base * Eigen::Vector3d(0.0, 0.0, kTurn_rad_s);
  const Eigen::Vector3d force =
      R_imu_base * Eigen::Vector3d(0.0, kRadius_m * kTurn_rad_s * kTurn_rad_s, kGravity_m_s2);
  tf2::toMsg(turning, imu.angular_velocity);
  tf2::toMsg(force, imu.linear_acceleration);
  return imu;
}

nav_msgs::Odometry poseAt(double time_s) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "room";
  odometry.child_frame_id = "base_link";
  odometry.header.stamp.fromSec(kStart_s + time_s);
  odometry.pose.pose = tf2::toMsg(T_room_base(time_s));
  return odometry;
}

geometry_msgs::TransformStamped mounting(const Eigen::Isometry3d& T_base_sensor,
                                         const char* sensor) {
  geometry_msgs::TransformStamped msg = tf2::eigenToTransform(T_base_sensor);
  msg.header.frame_id = "base_link";
  msg.header.stamp.fromSec(kStart_s);
  msg.child_frame_id = sensor;
  return msg;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  rosbag::Bag bag(argv[1], rosbag::bagmode::Write);
  tf2_msgs::TFMessage mountings;
  mountings.transforms = {mounting(T_base_lidar(), "lidar"), mounting(T_base_imu(), "imu_link")};
  bag.write("/tf_static", ros::Time(kStart_s), mountings);

  const int scans = static_cast<int>(std::lround(kDuration_s / kScan_s));
  constexpr int kImuPerScan = 10;
  for (int scan = 0; scan < scans; ++scan) {
    const double start_s = kScan_s * scan;
    for (int i = 0; i < kImuPerScan; ++i) {
      const double time_s = start_s + kScan_s * i / kImuPerScan;
      bag.write("/imu", ros::Time(kStart_s + time_s), imuAt(time_s));
    }
    bag.write("/truth", ros::Time(kStart_s + start_s), poseAt(start_s));
    // sent when the sweep is over
    bag.write("/points", ros::Time(kStart_s + start_s + kScan_s), scanAt(start_s));
  }
  return 0;
}
