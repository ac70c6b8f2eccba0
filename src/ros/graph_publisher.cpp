// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "graph_publisher.h"

#include <boost/make_shared.hpp>

#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kQueueSize = 100;
constexpr bool kLatched = true;

}  // namespace

GraphPublisher::GraphPublisher(ros::NodeHandle& nh, const FramesConfig& frames)
    : map_frame_(frameName(frames.map)),
      graph_pub_(nh.advertise<SituationalGraph>("graph", kQueueSize, kLatched)),
      optimization_pub_(nh.advertise<OptimizationReport>("optimization", kQueueSize)) {}

void GraphPublisher::publish(const GraphSnapshotConstPtr& graph, std::uint32_t number) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    graph_ = graph;
  }
  const auto msg = boost::make_shared<SituationalGraph>(toMsg(*graph, map_frame_));
  msg->session = number;
  graph_pub_.publish(msg);  // as a pointer, or it is serialized
}

void GraphPublisher::publish(const OptimizationSummary& summary) {
  optimization_pub_.publish(toMsg(summary, map_frame_));
}

GraphSnapshotConstPtr GraphPublisher::graph() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return graph_;
}

}  // namespace mrpt_sgraphs
