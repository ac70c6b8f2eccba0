// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "known_clouds.h"

#include <pcl_ros/point_cloud.h>

namespace mrpt_sgraphs {
namespace {

template <typename Publisher>
void publishAll(const GraphSnapshot& graph, const Publisher& publisher) {
  for (const KeyframeNode& keyframe : graph.keyframes) {
    const auto cloud = boost::make_shared<Cloud>();
    if (keyframe.cloud != nullptr) *cloud = *keyframe.cloud;
    cloud->header.stamp = toPclStamp(keyframe.stamp_s);
    publisher.publish(cloud);
  }
}

}  // namespace

KnownClouds::KnownClouds(ros::NodeHandle& nh) {
  constexpr std::uint32_t kAll = 0;
  pub_ = nh.advertise<Cloud>("known_points", kAll,
                             [this](const ros::SingleSubscriberPublisher& s) { onSubscriber(s); });
}

void KnownClouds::publish(const GraphSnapshotConstPtr& graph) {
  const std::lock_guard<std::mutex> lock(mutex_);
  graph_ = graph;
  publishAll(*graph, pub_);
}

void KnownClouds::onSubscriber(const ros::SingleSubscriberPublisher& subscriber) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (graph_ != nullptr) publishAll(*graph_, subscriber);
}

}  // namespace mrpt_sgraphs
