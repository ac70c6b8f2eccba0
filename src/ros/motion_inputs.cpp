// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "motion_inputs.h"

#include <ros/console.h>

#include <utility>

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kQueueSize = 4000;  ///< Ten seconds of a 400 Hz IMU.

Eigen::Vector3d toVector(const geometry_msgs::Vector3& msg) { return {msg.x, msg.y, msg.z}; }

template <typename Message>
std::unique_ptr<TopicWatchdog> watch(ros::NodeHandle& nh, const std::string& topic) {
  return std::make_unique<TopicWatchdog>(nh, nh.resolveName(topic),
                                         ros::message_traits::datatype<Message>());
}

}  // namespace

MotionInputs::MotionInputs(ros::NodeHandle& nh, const InputsConfig& inputs, OnImu on_imu,
                           OnOdom on_odom)
    : on_imu_(std::move(on_imu)), on_odom_(std::move(on_odom)) {
  const auto hints = ros::TransportHints().tcpNoDelay();
  if (inputs.imu) {
    imu_watchdog_ = watch<sensor_msgs::Imu>(nh, "imu");
    imu_sub_ = nh.subscribe("imu", kQueueSize, &MotionInputs::onImu, this, hints);
  }
  if (inputs.odom_in) {
    odom_watchdog_ = watch<nav_msgs::Odometry>(nh, "odom_in");
    odom_sub_ = nh.subscribe("odom_in", kQueueSize, &MotionInputs::onOdom, this, hints);
  }
}

void MotionInputs::setBase(const std::string& base_frame) {
  if (base_frame == base_frame_) return;
  base_frame_ = base_frame;
  for (const auto& msg : waiting_imu_) handOn(*msg);
  for (const auto& msg : waiting_odom_) handOn(*msg);
  waiting_imu_.clear();
  waiting_odom_.clear();
}

void MotionInputs::onImu(const sensor_msgs::ImuConstPtr& msg) {
  imu_watchdog_->arrived(msg->header.stamp);
  if (!base_frame_.empty()) return handOn(*msg);
  waiting_imu_.push_back(msg);
  if (waiting_imu_.size() > kMaxWaiting) waiting_imu_.pop_front();
}

void MotionInputs::onOdom(const nav_msgs::OdometryConstPtr& msg) {
  odom_watchdog_->arrived(msg->header.stamp);
  if (!base_frame_.empty()) return handOn(*msg);
  waiting_odom_.push_back(msg);
  if (waiting_odom_.size() > kMaxWaiting) waiting_odom_.pop_front();
}

void MotionInputs::handOn(const sensor_msgs::Imu& msg) {
  const auto T_base_imu = transforms_.find(base_frame_, frameName(msg.header.frame_id));
  if (!T_base_imu) return;
  // Turned only: what the lever arm adds to the specific force does not matter at rest, when it is
  // looked at.
  on_imu_({msg.header.stamp.toSec(), T_base_imu->linear() * toVector(msg.angular_velocity),
           T_base_imu->linear() * toVector(msg.linear_acceleration)});
}

void MotionInputs::handOn(const nav_msgs::Odometry& msg) {
  const auto T_odom_child = toPose(msg.pose.pose);
  if (!T_odom_child) {
    if (odom_warning_.passes()) {
      ROS_WARN(
          "odom_in of %.3f is not used: its pose is not finite or its quaternion not of length 1.",
          msg.header.stamp.toSec());
    }
    return;
  }
  const auto T_child_base = transforms_.find(frameName(msg.child_frame_id), base_frame_);
  if (!T_child_base) return;
  on_odom_({msg.header.stamp.toSec(), *T_odom_child * *T_child_base});
}

}  // namespace mrpt_sgraphs
