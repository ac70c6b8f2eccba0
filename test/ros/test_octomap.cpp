// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>

#include "map_messages.h"
#include "mapping/map_world.h"
#include "mrpt_sgraphs/mapping/octree.h"

namespace mrpt_sgraphs {
namespace {

using test::knownIn;
using test::roomOf6by4;
using test::walkThrough;

template <typename Condition>
bool waitFor(const Condition& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
  while (!condition() && ros::WallTime::now() < end) ros::WallDuration(0.05).sleep();
  return condition();
}

/// As octomap_msgs/conversions.h does it.
std::map<Voxel, bool> cellsOf(const octomap_msgs::Octomap& msg) {
  octomap::OcTree tree(msg.resolution);
  std::stringstream data;
  data.write(reinterpret_cast<const char*>(msg.data.data()),
             static_cast<std::streamsize>(msg.data.size()));
  tree.readBinaryData(data);
  tree.expand();
  std::map<Voxel, bool> cells;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey key = leaf.getKey();
    cells[{key[0] - 32768, key[1] - 32768, key[2] - 32768}] = tree.isNodeOccupied(*leaf);
  }
  return cells;
}

TEST(OctomapMessage, IsTheOfficialOneInABagAndTheMapCellByCell) {
  OccupancyMap map{MapConfig{}};
  map.update(walkThrough(roomOf6by4(), 5, 0.02));
  octomap_msgs::Octomap msg = toMsg(*octreeOf(map));
  msg.header.frame_id = "map";
  msg.header.stamp = ros::Time(1234.5);

  const std::string file = ros::param::param<std::string>("~bag", "");
  ASSERT_FALSE(file.empty());
  ros::NodeHandle nh;
  ros::Publisher publisher = nh.advertise<octomap_msgs::Octomap>("/octomap", 1);
  ASSERT_TRUE(waitFor([&] { return publisher.getNumSubscribers() > 0; })) << "the recorder";
  publisher.publish(msg);
  ASSERT_TRUE(waitFor([&] { return std::filesystem::exists(file); })) << file;

  rosbag::Bag bag(file);
  rosbag::View view(bag, rosbag::TopicQuery("/octomap"));
  ASSERT_EQ(view.size(), 1U);
  const auto connection = view.getConnections().front();
  EXPECT_EQ(connection->datatype, "octomap_msgs/Octomap");
  EXPECT_EQ(connection->md5sum, "9a45536b45c5e409cd49f04bb2d9999f");
  EXPECT_NE(connection->msg_def.find("int8[] data"), std::string::npos);
  EXPECT_NE(connection->msg_def.find("MSG: std_msgs/Header"), std::string::npos)
      << "readers without the package need all of it";
  const auto read = view.begin()->instantiate<octomap_msgs::Octomap>();
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->header.frame_id, "map");
  EXPECT_EQ(read->id, "OcTree");
  EXPECT_TRUE(read->binary);
  EXPECT_EQ(read->resolution, 0.1);
  EXPECT_EQ(cellsOf(*read), knownIn(map));
  bag.close();
  std::filesystem::remove(file);
}

TEST(OctomapMessage, OfAnEmptyMapHasNoData) {
  const octomap_msgs::Octomap msg = toMsg(*octreeOf(OccupancyMap{MapConfig{}}));
  EXPECT_TRUE(msg.data.empty());
  EXPECT_EQ(msg.id, "OcTree");
}

TEST(GridMessage, LiesWhereTheCellsAre) {
  FloorGrid grid;
  grid.cell_m = 0.1;
  grid.ground_m = -0.25;
  grid.cells = CellGrid<std::int8_t>(CellBox{{-3, 5}, {0, 7}}, FloorGrid::kUnknown);
  grid.cells[{-3, 5}] = FloorGrid::kFree;
  grid.cells[{-2, 5}] = FloorGrid::kOccupied;
  grid.cells[{0, 7}] = FloorGrid::kOccupied;
  const nav_msgs::OccupancyGrid msg = toMsg(grid);
  EXPECT_EQ(msg.info.width, 4U);
  EXPECT_EQ(msg.info.height, 3U);
  EXPECT_FLOAT_EQ(msg.info.resolution, 0.1F);
  EXPECT_NEAR(msg.info.origin.position.x, -0.3, 1e-12);
  EXPECT_NEAR(msg.info.origin.position.y, 0.5, 1e-12);
  EXPECT_EQ(msg.info.origin.position.z, -0.25);
  EXPECT_EQ(msg.info.origin.orientation.w, 1.0);
  EXPECT_EQ(msg.data, (std::vector<std::int8_t>{0, 100, -1, -1, -1, -1, -1, -1, -1, -1, -1, 100}))
      << "row by row from the origin, along x first";
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_octomap");
  testing::InitGoogleTest(&argc, argv);
  const ros::NodeHandle keep_ros_running;
  return RUN_ALL_TESTS();
}
