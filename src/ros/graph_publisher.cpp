// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_publisher.h"

#include <boost/make_shared.hpp>

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kQueueSize = 100;
constexpr double kBroadcastEvery_s = 0.05;
constexpr bool kLatched = true;

}  // namespace

GraphPublisher::GraphPublisher(ros::NodeHandle& nh, const FramesConfig& frames)
    : map_frame_(frameName(frames.map)),
      odom_frame_(frameName(frames.odom)),
      graph_pub_(nh.advertise<SituationalGraph>("graph", kQueueSize, kLatched)),
      odom2map_pub_(
          nh.advertise<geometry_msgs::TransformStamped>("odom2map", kQueueSize, kLatched)),
      optimization_pub_(nh.advertise<OptimizationReport>("optimization", kQueueSize)),
      timer_(nh.createTimer(ros::Duration(kBroadcastEvery_s),
                            [this](const ros::TimerEvent&) { broadcast(); })) {}

void GraphPublisher::publish(const GraphSnapshotConstPtr& graph, std::uint32_t session) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    graph_ = graph;
  }
  const auto msg = boost::make_shared<SituationalGraph>(toMsg(*graph, map_frame_));
  msg->session = session;
  graph_pub_.publish(msg);  // as a pointer, or it is serialized
  odom2map_pub_.publish(
      toMsg(graph->T_map_odom, toRosTime(graph->stamp_s), map_frame_, odom_frame_));
}

void GraphPublisher::publish(const OptimizationSummary& summary) {
  optimization_pub_.publish(toMsg(summary, map_frame_));
}

GraphSnapshotConstPtr GraphPublisher::graph() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return graph_;
}

void GraphPublisher::broadcast() {
  const GraphSnapshotConstPtr graph = this->graph();
  const ros::Time now = ros::Time::now();
  // tf complains of two transforms of one stamp: a simulated clock may stand still
  if (!graph || now == last_broadcast_) return;
  last_broadcast_ = now;
  broadcaster_.sendTransform(toMsg(graph->T_map_odom, now, map_frame_, odom_frame_));
}

}  // namespace mrpt_sgraphs
