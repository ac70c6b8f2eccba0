// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <utility>

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {

/// Where someone says that the robot is.
///
/// Subscribes  initialpose  (geometry_msgs/PoseWithCovarianceStamped)  in frames/map, as rviz sends it
class InitialPose {
 public:
  /// @param on_pose  Called with T_map_base.
  InitialPose(ros::NodeHandle& nh, std::string map_frame, std::function<void(const Pose&)> on_pose)
      : map_frame_(std::move(map_frame)),
        on_pose_(std::move(on_pose)),
        sub_(nh.subscribe("initialpose", 1, &InitialPose::onMessage, this)) {}

 private:
  void onMessage(const geometry_msgs::PoseWithCovarianceStamped::ConstPtr& msg) {
    const auto T_map_base = toPose(msg->pose.pose);
    const std::string frame = frameName(msg->header.frame_id);
    if (frame != map_frame_) {
      ROS_WARN("Not used: initialpose is in '%s', not in '%s'.", frame.c_str(), map_frame_.c_str());
    } else if (!T_map_base) {
      ROS_WARN("Not used: initialpose is no pose.");
    } else {
      on_pose_(*T_map_base);
    }
  }

  const std::string map_frame_;
  const std::function<void(const Pose&)> on_pose_;
  ros::Subscriber sub_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
