// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "map_publisher.h"

#include <pcl_conversions/pcl_conversions.h>
#include <pcl_ros/point_cloud.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <set>
#include <string>
#include <utility>

#include "map_messages.h"
#include "mrpt_sgraphs/mapping/octree.h"

namespace mrpt_sgraphs {

MapPublisher::MapPublisher(const ros::NodeHandle& nh, const MapConfig& config,
                           std::function<void()> on_listener)
    : nh_(nh), config_(config), on_listener_(std::move(on_listener)) {
  octomap_.publisher = advertise<octomap_msgs::Octomap>("octomap");
  occupied_.publisher = advertise<VoxelCloud>("occupied");
  map_points_.publisher = advertise<Cloud>("map_points");
  startAgain();
}

template <typename Message>
ros::Publisher MapPublisher::advertise(const std::string& name) {
  constexpr std::uint32_t kQueueSize = 1;
  constexpr bool kLatched = true;
  const auto on_listener = [tell = on_listener_](const ros::SingleSubscriberPublisher&) { tell(); };
  return nh_.advertise<Message>(name, kQueueSize, on_listener, {}, {}, kLatched);
}

void MapPublisher::startAgain() {
  occupancy_ = std::make_unique<OccupancyMap>(config_);
  points_ = std::make_unique<PointMap>(config_.points_voxel_m);
  grids_.clear();
  ++occupancy_revision_;
  ++points_revision_;
}

void MapPublisher::publish(const GraphSnapshot& graph, const std_msgs::Header& header) {
  advertiseGrids(graph);
  if (isOccupancyWanted()) {
    if (occupancy_->update(graph)) ++occupancy_revision_;
    publishOccupancy(header);
    publishGrids(graph, header);
  }
  publishPoints(graph, header);
}

void MapPublisher::advertiseGrids(const GraphSnapshot& graph) {
  std::set<FloorId> present;
  for (const FloorNode& floor : graph.floors) {
    present.insert(floor.id);
    GridTopic& topic = grids_[floor.id];
    if (topic.publisher) continue;
    topic.publisher =
        advertise<nav_msgs::OccupancyGrid>("grid/floor_" + std::to_string(floor.id.value));
  }
  for (auto topic = grids_.begin(); topic != grids_.end();) {
    topic = present.count(topic->first) == 0 ? grids_.erase(topic) : std::next(topic);
  }
}

bool MapPublisher::isOccupancyWanted() const {
  const auto isHeard = [](const ros::Publisher& publisher) {
    return publisher.getNumSubscribers() > 0;
  };
  return isHeard(octomap_.publisher) || isHeard(occupied_.publisher) ||
         std::any_of(grids_.begin(), grids_.end(),
                     [&](const auto& topic) { return isHeard(topic.second.publisher); });
}

void MapPublisher::publishOccupancy(const std_msgs::Header& header) {
  if (octomap_.wants(occupancy_revision_)) {
    const auto msg = boost::make_shared<octomap_msgs::Octomap>(toMsg(*octreeOf(*occupancy_)));
    msg->header = header;
    octomap_.publisher.publish(msg);  // as a pointer, or it is serialized
    octomap_.sent = occupancy_revision_;
  }
  if (occupied_.wants(occupancy_revision_)) {
    const VoxelCloud::Ptr cloud = occupiedCentres(*occupancy_);
    cloud->header = pcl_conversions::toPCL(header);
    occupied_.publisher.publish(pcl::ros_ptr(cloud));
    occupied_.sent = occupancy_revision_;
  }
}

void MapPublisher::publishGrids(const GraphSnapshot& graph, const std_msgs::Header& header) {
  const bool is_any_heard = std::any_of(grids_.begin(), grids_.end(), [](const auto& topic) {
    return topic.second.publisher.getNumSubscribers() > 0;
  });
  if (!is_any_heard) return;
  for (FloorGrid& grid : floorGrids(*occupancy_, graph, config_)) {
    GridTopic& topic = grids_.at(grid.floor);
    if (topic.publisher.getNumSubscribers() == 0 || grid == topic.sent) continue;
    const auto msg = boost::make_shared<nav_msgs::OccupancyGrid>(toMsg(grid));
    msg->header = header;
    msg->info.map_load_time = header.stamp;
    topic.publisher.publish(msg);
    topic.sent = std::move(grid);
  }
}

void MapPublisher::publishPoints(const GraphSnapshot& graph, const std_msgs::Header& header) {
  if (map_points_.publisher.getNumSubscribers() == 0) return;
  if (points_->update(graph)) ++points_revision_;
  if (!map_points_.wants(points_revision_)) return;
  const Cloud::Ptr cloud = points_->cloud();
  cloud->header = pcl_conversions::toPCL(header);
  map_points_.publisher.publish(pcl::ros_ptr(cloud));
  map_points_.sent = points_revision_;
}

}  // namespace mrpt_sgraphs
