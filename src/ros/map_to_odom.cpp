// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "map_to_odom.h"

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kQueueSize = 100;
constexpr double kBroadcastEvery_s = 0.05;
constexpr bool kLatched = true;

}  // namespace

MapToOdom::MapToOdom(ros::NodeHandle& nh, const FramesConfig& frames)
    : map_frame_(frameName(frames.map)),
      odom_frame_(frameName(frames.odom)),
      odom2map_pub_(
          nh.advertise<geometry_msgs::TransformStamped>("odom2map", kQueueSize, kLatched)),
      timer_(nh.createTimer(ros::Duration(kBroadcastEvery_s),
                            [this](const ros::TimerEvent&) { broadcast(); })) {}

void MapToOdom::publish(const Pose& T_map_odom, double stamp_s) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom_ = T_map_odom;
  }
  odom2map_pub_.publish(toMsg(T_map_odom, toRosTime(stamp_s), map_frame_, odom_frame_));
}

void MapToOdom::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  T_map_odom_.reset();
}

void MapToOdom::broadcast() {
  std::optional<Pose> T_map_odom;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom = T_map_odom_;
  }
  const ros::Time now = ros::Time::now();
  // tf complains of two transforms of one stamp: a simulated clock may stand still
  if (!T_map_odom || now == last_broadcast_) return;
  last_broadcast_ = now;
  broadcaster_.sendTransform(toMsg(*T_map_odom, now, map_frame_, odom_frame_));
}

}  // namespace mrpt_sgraphs
