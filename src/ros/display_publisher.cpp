// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "display_publisher.h"

#include <nav_msgs/Path.h>
#include <pcl_ros/point_cloud.h>
#include <visualization_msgs/MarkerArray.h>

#include <utility>

#include "mrpt_sgraphs/mapping/wall_points.h"
#include "mrpt_sgraphs/ros/conversions.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::uint32_t kQueueSize = 1;
constexpr bool kLatched = true;
constexpr double kResolution_m = 0.1;  ///< Coarser than what is saved: it goes over the network.

}  // namespace

DisplayPublisher::DisplayPublisher(ros::NodeHandle& nh, GraphView view, Source source)
    : view_(std::move(view)),
      source_(std::move(source)),
      markers_pub_(nh.advertise<visualization_msgs::MarkerArray>("markers", kQueueSize, kLatched)),
      trajectory_pub_(nh.advertise<nav_msgs::Path>("trajectory", kQueueSize, kLatched)),
      wall_points_pub_(nh.advertise<ColouredCloud>("wall_points", kQueueSize, kLatched)),
      graph_timer_(nh.createSteadyTimer(ros::WallDuration(1.0),
                                        [this](const ros::SteadyTimerEvent&) {
                                          publishMarkers();
                                          publishTrajectory();
                                        })),
      points_timer_(
          nh.createSteadyTimer(ros::WallDuration(3.0), [this](const ros::SteadyTimerEvent&) {
            publishWallPoints();
          })) {}

void DisplayPublisher::publishMarkers() {
  const GraphSnapshotConstPtr graph = source_.graph();
  if (!graph || graph == graph_in_markers_ || markers_pub_.getNumSubscribers() == 0) return;
  graph_in_markers_ = graph;
  const auto optimization = source_.last_optimization();
  markers_pub_.publish(toMarkers(*graph, view_, optimization ? &*optimization : nullptr));
}

void DisplayPublisher::publishTrajectory() {
  if (trajectory_pub_.getNumSubscribers() == 0) return;
  trajectory_pub_.publish(toMsg(source_.trajectory(), view_.map_frame));
}

void DisplayPublisher::publishWallPoints() {
  const GraphSnapshotConstPtr graph = source_.graph();
  if (!graph || graph == graph_in_wall_points_ || wall_points_pub_.getNumSubscribers() == 0) return;
  graph_in_wall_points_ = graph;
  WallPointsConfig config;
  config.resolution_m = kResolution_m;
  const auto points = wallPoints(*graph, config);
  points->header.frame_id = view_.map_frame;
  wall_points_pub_.publish(pcl::ros_ptr(points));
}

}  // namespace mrpt_sgraphs
