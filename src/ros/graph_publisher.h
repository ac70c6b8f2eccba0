// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"
#include "ros_config.h"

namespace mrpt_sgraphs {

/// What follows every change of the graph at once, and the transform from map to odom.
///
/// Publishes  graph         (mrpt_sgraphs/SituationalGraph, latched)   frames/map
///            odom2map      (geometry_msgs/TransformStamped, latched)  frames/map to frames/odom
///            optimization  (mrpt_sgraphs/OptimizationReport)
///            tf            frames/map -> frames/odom, 20 Hz
class GraphPublisher {
 public:
  GraphPublisher(ros::NodeHandle& nh, const FramesConfig& frames);

  /// These two may be called from any thread.
  void publish(const GraphSnapshotConstPtr& graph, std::uint32_t session);
  void publish(const OptimizationSummary& summary);

  /// The last one published, or null.
  GraphSnapshotConstPtr graph() const;

 private:
  void broadcast();

  const std::string map_frame_;
  const std::string odom_frame_;
  mutable std::mutex mutex_;  ///< Guards graph_.
  GraphSnapshotConstPtr graph_;
  ros::Time last_broadcast_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher graph_pub_;
  ros::Publisher odom2map_pub_;
  ros::Publisher optimization_pub_;
  ros::Timer timer_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
