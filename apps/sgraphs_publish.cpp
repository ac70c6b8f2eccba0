// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A saved run to look at: publishes what the nodelets would, until it is stopped.
#include <pcl_ros/point_cloud.h>
#include <ros/ros.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "mrpt_sgraphs/io/graph_reader.h"
#include "mrpt_sgraphs/io/pcd_reader.h"
#include "mrpt_sgraphs/io/tum.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/ros/markers.h"

namespace {

namespace fs = std::filesystem;
using namespace mrpt_sgraphs;

constexpr const char* kUsage =
    "usage: sgraphs_publish DIR [_map_frame:=map] [_layer_lift_m:=10]\n"
    "\n"
    "Publishes what sgraphs_offline or the service `dump` wrote into DIR, for rviz: the topics\n"
    "graph, markers, map_points and trajectory, latched.\n";

constexpr std::uint32_t kQueueSize = 1;
constexpr bool kLatched = true;

/// @throws std::runtime_error for a file that cannot be read, naming it.
GraphSnapshotConstPtr readGraph(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return readGraphJson(file, path.string()).snapshot();
}

pcl::PointCloud<pcl::PointXYZ>::Ptr readMap(const fs::path& path, const std::string& map_frame) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->header.frame_id = map_frame;
  for (const Eigen::Vector3f& point : readPcd(path.string())) {
    cloud->push_back({point.x(), point.y(), point.z()});
  }
  return cloud;
}

/// What is not in the folder is not published.
void publish(const fs::path& folder) {
  const ros::NodeHandle params("~");
  const auto map_frame = params.param<std::string>("map_frame", "map");
  const double lift_m = params.param("layer_lift_m", 10.0);
  ros::NodeHandle nh;
  const auto graph_pub = nh.advertise<SituationalGraph>("graph", kQueueSize, kLatched);
  const auto markers_pub =
      nh.advertise<visualization_msgs::MarkerArray>("markers", kQueueSize, kLatched);
  const auto map_pub =
      nh.advertise<pcl::PointCloud<pcl::PointXYZ>>("map_points", kQueueSize, kLatched);
  const auto trajectory_pub = nh.advertise<nav_msgs::Path>("trajectory", kQueueSize, kLatched);

  const GraphSnapshotConstPtr graph = readGraph(folder / "graph.json");
  graph_pub.publish(toMsg(*graph, map_frame));
  markers_pub.publish(toMarkers(*graph, {map_frame, lift_m}, nullptr));
  if (fs::exists(folder / "map.pcd")) {
    map_pub.publish(pcl::ros_ptr(readMap(folder / "map.pcd", map_frame)));
  }
  if (fs::exists(folder / "trajectory.tum")) {
    trajectory_pub.publish(toMsg(readTum((folder / "trajectory.tum").string()), map_frame));
  }
  ROS_INFO("%zu keyframes, %zu walls and %zu rooms of %s, until stopped", graph->keyframes.size(),
           graph->walls.size(), graph->rooms.size(), folder.string().c_str());
  ros::spin();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "sgraphs_publish");
  if (argc != 2 || std::string(argv[1]).rfind("-", 0) == 0) {
    std::cerr << kUsage;
    return 1;
  }
  try {
    publish(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "sgraphs_publish: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
