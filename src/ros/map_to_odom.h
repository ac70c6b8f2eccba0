// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <mutex>
#include <optional>
#include <string>

#include "mrpt_sgraphs/geometry/pose.h"
#include "ros_config.h"

namespace mrpt_sgraphs {

/// Where odometry's frame lies in the map, as long as that is known.
///
/// Publishes  odom2map  (geometry_msgs/TransformStamped, latched)  frames/map to frames/odom
///            tf        frames/map -> frames/odom, 20 Hz
class MapToOdom {
 public:
  MapToOdom(ros::NodeHandle& nh, const FramesConfig& frames);

  /// These two may be called from any thread.
  void publish(const Pose& T_map_odom, double stamp_s);
  void forget();  ///< It is not known any more.

 private:
  void broadcast();

  const std::string map_frame_;
  const std::string odom_frame_;
  std::mutex mutex_;  ///< Guards the next one.
  std::optional<Pose> T_map_odom_;
  ros::Time last_broadcast_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher odom2map_pub_;
  ros::Timer timer_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
