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

/// What follows every change of the graph at once.
///
/// Publishes  graph         (mrpt_sgraphs/SituationalGraph, latched)   frames/map
///            optimization  (mrpt_sgraphs/OptimizationReport)
class GraphPublisher {
 public:
  GraphPublisher(ros::NodeHandle& nh, const FramesConfig& frames);

  /// These two may be called from any thread.
  void publish(const GraphSnapshotConstPtr& graph, std::uint32_t number);
  void publish(const OptimizationSummary& summary);

  /// The last one published, or null.
  GraphSnapshotConstPtr graph() const;

 private:
  const std::string map_frame_;
  mutable std::mutex mutex_;  ///< Guards graph_.
  GraphSnapshotConstPtr graph_;
  ros::Publisher graph_pub_;
  ros::Publisher optimization_pub_;
};

}  // namespace mrpt_sgraphs
