// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <functional>
#include <optional>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/io/tum.h"
#include "mrpt_sgraphs/ros/markers.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// What is made to be looked at, and only while somebody looks. Takes its time: it wants a callback
/// queue that nothing urgent waits in.
///
/// Publishes  markers     (visualization_msgs/MarkerArray, latched)  the layers, every second
///            trajectory  (nav_msgs/Path, latched)                   every scan, every second
///            wall_points (sensor_msgs/PointCloud2, latched)         decimated, every three seconds,
///                                                                   coloured by walls
/// All but the trajectory only if the graph changed.
class DisplayPublisher {
 public:
  /// Where the values come from; `graph` may give null.
  struct Source {
    std::function<GraphSnapshotConstPtr()> graph;
    std::function<Trajectory()> trajectory;
    std::function<std::optional<OptimizationSummary>()> last_optimization;
  };

  DisplayPublisher(ros::NodeHandle& nh, GraphView view, Source source);

 private:
  void publishMarkers();
  void publishTrajectory();
  void publishWallPoints();

  const GraphView view_;
  const Source source_;
  GraphSnapshotConstPtr graph_in_markers_;
  GraphSnapshotConstPtr graph_in_wall_points_;
  ros::Publisher markers_pub_;
  ros::Publisher trajectory_pub_;
  ros::Publisher wall_points_pub_;
  ros::SteadyTimer graph_timer_;
  ros::SteadyTimer points_timer_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs
