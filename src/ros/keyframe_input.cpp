// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "keyframe_input.h"

#include <pcl_ros/point_cloud.h>

#include <utility>

#include "cloud_trace.h"
#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {

KeyframeInput::KeyframeInput(ros::NodeHandle& nh, std::uint32_t queue_size, Listener listener)
    : listener_(std::move(listener)),
      scan_sub_(nh.subscribe("scan_odometry", queue_size, &KeyframeInput::onScan, this)),
      keyframe_sub_(nh.subscribe("keyframe", queue_size, &KeyframeInput::onKeyframe, this)),
      cloud_sub_(nh.subscribe("keyframe_points", queue_size, &KeyframeInput::onCloud, this)),
      planes_sub_(nh.subscribe("keyframe_planes", queue_size, &KeyframeInput::onPlanes, this)) {}

void KeyframeInput::onScan(const ScanOdometryConstPtr& msg) {
  if (!isOfThisSession(msg->session)) return;
  const auto motion = toScanMotion(*msg);
  if (motion) listener_.on_scan(*motion, toScanReport(*msg));
}

void KeyframeInput::onKeyframe(const KeyframeStampedConstPtr& msg) {
  if (!isOfThisSession(msg->session)) return;
  add(matcher_.add<0>(pcl_conversions::toPCL(msg->header.stamp), msg));
}

void KeyframeInput::onCloud(const CloudConstPtr& cloud) {
  traceCloud("receive", "keyframe_points", cloud.get());
  add(matcher_.add<1>(cloud->header.stamp, cloud));
}

void KeyframeInput::onPlanes(const KeyframePlanesConstPtr& msg) {
  traceCloud("receive", "keyframe_planes", msg.get());
  if (!isOfThisSession(msg->session)) return;
  add(matcher_.add<2>(pcl_conversions::toPCL(msg->header.stamp), msg));
}

void KeyframeInput::add(const std::optional<Matcher::Set>& set) {
  if (!set) return;
  const auto& [msg, cloud, planes] = *set;
  auto keyframe = toKeyframe(*msg);
  if (!keyframe) return;
  keyframe->cloud = pcl::pcl_ptr(cloud);
  keyframe->planes = toObservedPlanes(*planes);
  listener_.on_keyframe(*keyframe, planes->segment_ms);
}

/// A session that is newer begins, one that is older ended: nothing of it is waited for.
bool KeyframeInput::isOfThisSession(std::uint32_t session) {
  if (session > session_) {
    session_ = session;
    matcher_.clear();
    listener_.on_restart();
  }
  return session == session_;
}

}  // namespace mrpt_sgraphs
