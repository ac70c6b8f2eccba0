// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <memory>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/floor_grid.h"
#include "mrpt_sgraphs/mapping/map_config.h"
#include "mrpt_sgraphs/mapping/occupancy_map.h"
#include "mrpt_sgraphs/mapping/point_map.h"

namespace mrpt_sgraphs {

/// The maps as messages: made while somebody listens, sent again only if they changed. Who comes
/// late gets the last one at once, and the newest with the next graph.
///
/// Publishes  octomap          (octomap_msgs/Octomap, latched)      binary
///            occupied         (sensor_msgs/PointCloud2, latched)   its occupied cells
///            map_points       (sensor_msgs/PointCloud2, latched)   averaged in voxels
///            grid/floor_<id>  (nav_msgs/OccupancyGrid, latched)    of each floor
/// All with the stamp and the frame of the graph.
class MapPublisher {
 public:
  /// @param on_listener  Called when somebody subscribes, from any thread.
  MapPublisher(const ros::NodeHandle& nh, const MapConfig& config,
               std::function<void()> on_listener);

  /// @param graph  Its keyframes have the clouds that the maps are made of.
  void publish(const GraphSnapshot& graph, const std_msgs::Header& header);

  /// Ids of what comes have nothing to do with those before.
  void startAgain();

  std::size_t knownVoxels() const { return occupancy_->size(); }

 private:
  /// A topic, and which map was sent last.
  struct Topic {
    ros::Publisher publisher;
    std::size_t sent = 0;

    bool wants(std::size_t revision) const {
      return sent != revision && publisher.getNumSubscribers() > 0;
    }
  };
  struct GridTopic {
    ros::Publisher publisher;
    FloorGrid sent;
  };

  template <typename Message>
  ros::Publisher advertise(const std::string& name);
  void advertiseGrids(const GraphSnapshot& graph);
  bool isOccupancyWanted() const;
  void publishOccupancy(const std_msgs::Header& header);
  void publishGrids(const GraphSnapshot& graph, const std_msgs::Header& header);
  void publishPoints(const GraphSnapshot& graph, const std_msgs::Header& header);

  ros::NodeHandle nh_;
  const MapConfig config_;
  const std::function<void()> on_listener_;
  std::unique_ptr<OccupancyMap> occupancy_;
  std::unique_ptr<PointMap> points_;
  std::size_t occupancy_revision_ = 1;
  std::size_t points_revision_ = 1;
  Topic octomap_;
  Topic occupied_;
  Topic map_points_;
  std::map<FloorId, GridTopic> grids_;
};

}  // namespace mrpt_sgraphs
