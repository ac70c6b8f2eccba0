// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "mrpt_sgraphs/frontend/motion_buffers.h"
#include "ros_config.h"
#include "static_transforms.h"
#include "topic_watchdog.h"

namespace mrpt_sgraphs {

/// The robot's IMU and odometry, brought into the base frame.
///
/// Subscribes  imu      (sensor_msgs/Imu)     if inputs/imu is set
///             odom_in  (nav_msgs/Odometry)   if inputs/odom_in is set
class MotionInputs {
 public:
  using OnImu = std::function<void(const ImuSample&)>;
  using OnOdom = std::function<void(const OdomSample&)>;

  MotionInputs(ros::NodeHandle& nh, const InputsConfig& inputs, OnImu on_imu, OnOdom on_odom);

  /// The first cloud says what the base is; messages that came before it are handed on now.
  void setBase(const std::string& base_frame);

 private:
  static constexpr std::size_t kMaxWaiting = 1000;

  void onImu(const sensor_msgs::ImuConstPtr& msg);
  void onOdom(const nav_msgs::OdometryConstPtr& msg);
  void handOn(const sensor_msgs::Imu& msg);
  void handOn(const nav_msgs::Odometry& msg);

  OnImu on_imu_;
  OnOdom on_odom_;
  std::string base_frame_;  ///< Empty until it is known.
  std::deque<sensor_msgs::ImuConstPtr> waiting_imu_;
  std::deque<nav_msgs::OdometryConstPtr> waiting_odom_;
  StaticTransforms transforms_;
  Throttle odom_warning_;
  std::unique_ptr<TopicWatchdog> imu_watchdog_;
  std::unique_ptr<TopicWatchdog> odom_watchdog_;
  ros::Subscriber imu_sub_;
  ros::Subscriber odom_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
