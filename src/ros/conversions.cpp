// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/ros/conversions.h"

#include <pcl_conversions/pcl_conversions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "surface_message.h"

namespace mrpt_sgraphs {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// What messages with a pose to the last bit have in common: `pose` and `rotation`.
template <typename Message>
void setExactPose(const Pose& T, Message* msg) {
  msg->pose = toPoseMsg(T);
  Eigen::Map<RowMajor3>(msg->rotation.data()) = T.linear();
}

/// Nothing for a message whose pose is none.
template <typename Message>
std::optional<Pose> exactPoseOf(const Message& msg) {
  std::optional<Pose> T = toPose(msg.pose);
  if (!T) return std::nullopt;
  constexpr double kMaxRounding = 1e-9;  // what is farther from the quaternion was not filled in
  const Eigen::Matrix3d rotation = Eigen::Map<const RowMajor3>(msg.rotation.data());
  if ((rotation - T->linear()).norm() < kMaxRounding) T->linear() = rotation;
  return T;
}

std::vector<std::uint64_t> toMsg(const KeyframeRuns& keyframes) {
  std::vector<std::uint64_t> msg;
  for (const KeyframeRuns::Run& run : keyframes.runs()) {
    msg.push_back(run.first.value);
    msg.push_back(run.last.value);
  }
  return msg;
}

}  // namespace

ros::Time toRosTime(double stamp_s) { return pcl_conversions::fromPCL(toPclStamp(stamp_s)); }

double toSeconds(const ros::Time& stamp) {
  return 1e-6 * static_cast<double>(pcl_conversions::toPCL(stamp));
}

geometry_msgs::Pose toPoseMsg(const Pose& T) {
  geometry_msgs::Pose msg;
  msg.position = tf2::toMsg(Eigen::Vector3d(T.translation()));
  msg.orientation = tf2::toMsg(Eigen::Quaterniond(T.linear()).normalized());
  return msg;
}

geometry_msgs::TransformStamped toMsg(const Pose& T_parent_child, ros::Time stamp,
                                      const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped msg = tf2::eigenToTransform(T_parent_child);
  msg.header.stamp = stamp;
  msg.header.frame_id = parent;
  msg.child_frame_id = child;
  return msg;
}

boost::array<double, 36> toMsg(const Matrix6& matrix) {
  boost::array<double, 36> msg;
  Eigen::Map<RowMajor6>(msg.data()) = matrix;
  return msg;
}

std::optional<Pose> toPose(const geometry_msgs::Pose& msg) {
  Eigen::Vector3d position;
  Eigen::Quaterniond rotation;
  tf2::fromMsg(msg.position, position);
  tf2::fromMsg(msg.orientation, rotation);
  constexpr double kMaxError = 0.1;  // rounding errors are smaller, other mistakes larger
  const bool is_rotation = std::abs(rotation.norm() - 1.0) < kMaxError;  // false for NaN
  if (!position.allFinite() || !is_rotation) return std::nullopt;
  return Eigen::Translation3d(position) * Pose(rotation.normalized());
}

Matrix6 toMatrix(const boost::array<double, 36>& msg) {
  return Eigen::Map<const RowMajor6>(msg.data());
}

RawCloud viewOf(const sensor_msgs::PointCloud2& msg) {
  RawCloud view;
  view.stamp_s = msg.header.stamp.toSec();
  view.frame_id = msg.header.frame_id;
  view.width = msg.width;
  view.height = msg.height;
  view.point_step = msg.point_step;
  view.row_step = msg.row_step;
  view.is_bigendian = msg.is_bigendian != 0;
  for (const sensor_msgs::PointField& field : msg.fields) {
    view.fields.push_back(
        {field.name, field.offset, static_cast<RawCloud::Type>(field.datatype), field.count});
  }
  view.data = msg.data.data();
  view.size = msg.data.size();
  return view;
}

ScanOdometry toScanOdometry(const OdometryResult& result, const std_msgs::Header& header,
                            const std::string& base_frame) {
  ScanOdometry msg;
  msg.header = header;
  msg.child_frame_id = base_frame;
  setExactPose(result.T_odom_base, &msg);
  msg.covariance = toMsg(result.covariance);
  msg.registered = result.registered;
  msg.degenerate_directions = result.degenerate_directions;
  msg.inlier_ratio = result.inlier_ratio;
  msg.iterations = result.iterations;
  msg.deskew_ms = result.deskew_ms;
  msg.register_ms = result.register_ms;
  msg.map_ms = result.map_ms;
  msg.problem = result.problem;
  return msg;
}

nav_msgs::Odometry toOdometry(const OdometryResult& result, const std_msgs::Header& header,
                              const std::string& base_frame, double dt_s) {
  nav_msgs::Odometry msg;
  msg.header = header;
  msg.child_frame_id = base_frame;
  msg.pose.pose = toPoseMsg(result.T_odom_base);
  msg.twist.twist = tf2::toMsg(result.velocity_base);
  if (dt_s > 0.0) msg.twist.covariance = toMsg(Matrix6(result.covariance / (dt_s * dt_s)));
  return msg;
}

std::optional<ScanMotion> toScanMotion(const ScanOdometry& msg) {
  const auto T_odom_base = exactPoseOf(msg);
  if (!T_odom_base) return std::nullopt;
  return ScanMotion{toSeconds(msg.header.stamp), *T_odom_base, toMatrix(msg.covariance)};
}

ScanReport toScanReport(const ScanOdometry& msg) {
  ScanReport report;
  report.stamp_s = toSeconds(msg.header.stamp);
  report.deskew_ms = msg.deskew_ms;
  report.register_ms = msg.register_ms;
  report.map_ms = msg.map_ms;
  report.registered = msg.registered != 0;
  return report;
}

KeyframeStamped toMsg(const Keyframe& keyframe, const std_msgs::Header& header,
                      const std::string& base_frame) {
  KeyframeStamped msg;
  msg.header = header;
  msg.child_frame_id = base_frame;
  setExactPose(keyframe.T_odom_base, &msg);
  msg.covariance = toMsg(keyframe.covariance);
  if (keyframe.cloud != nullptr) msg.viewpoint = tf2::toMsg(viewpointOf(*keyframe.cloud));
  return msg;
}

std::optional<Keyframe> toKeyframe(const KeyframeStamped& msg) {
  const auto T_odom_base = exactPoseOf(msg);
  if (!T_odom_base) return std::nullopt;
  return Keyframe{toSeconds(msg.header.stamp), *T_odom_base, toMatrix(msg.covariance), nullptr, nullptr};
}

OptimizationReport toMsg(const OptimizationSummary& summary, const std::string& map_frame) {
  OptimizationReport msg;
  msg.header.stamp = toRosTime(summary.stamp_s);
  msg.header.frame_id = map_frame;
  msg.kind = summary.kind;
  msg.mode = summary.mode;
  msg.room = toIdMsg(summary.room);
  msg.keyframes_active = summary.keyframes_active;
  msg.keyframes_marginalized = summary.keyframes_marginalized;
  msg.dropped = summary.dropped;
  msg.walls = summary.walls;
  msg.rooms = summary.rooms;
  msg.floors = summary.floors;
  msg.factors = summary.factors;
  msg.free_variables = summary.free_variables;
  msg.free_keyframes = toMsg(summary.free_keyframes);
  msg.fixed_keyframes = toMsg(summary.fixed_keyframes);
  msg.iterations = summary.iterations;
  msg.cost_before = summary.cost_before;
  msg.cost_after = summary.cost_after;
  msg.converged = summary.converged;
  msg.problem = summary.problem;
  msg.total_ms = summary.total_ms;
  msg.linearize_ms = summary.linearize_ms;
  msg.factorize_ms = summary.factorize_ms;
  return msg;
}

nav_msgs::Path toMsg(const Trajectory& trajectory, const std::string& map_frame) {
  nav_msgs::Path msg;
  msg.header.frame_id = map_frame;
  if (!trajectory.empty()) msg.header.stamp = toRosTime(trajectory.back().stamp_s);
  msg.poses.reserve(trajectory.size());
  for (const StampedPose& line : trajectory) {
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = toRosTime(line.stamp_s);
    pose.header.frame_id = map_frame;
    pose.pose = toPoseMsg(line.T_world_body);
    msg.poses.push_back(pose);
  }
  return msg;
}

}  // namespace mrpt_sgraphs
