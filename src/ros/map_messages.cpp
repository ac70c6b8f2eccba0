// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "map_messages.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {

octomap_msgs::Octomap toMsg(const octomap::OcTree& tree) {
  octomap_msgs::Octomap msg;
  msg.binary = true;
  msg.id = tree.getTreeType();
  msg.resolution = tree.getResolution();
  // octomap_server sends nothing for a tree without a root, and readers take no data for that
  if (tree.getRoot() == nullptr) return msg;
  std::ostringstream stream(std::ios_base::out | std::ios_base::binary);
  if (!tree.writeBinaryData(stream)) throw std::runtime_error("the OctoMap could not be written");
  const std::string data = stream.str();
  msg.data.assign(data.begin(), data.end());
  return msg;
}

nav_msgs::OccupancyGrid toMsg(const FloorGrid& grid) {
  nav_msgs::OccupancyGrid msg;
  const CellBox& box = grid.cells.box();
  msg.info.resolution = static_cast<float>(grid.cell_m);
  msg.info.width = static_cast<std::uint32_t>(box.columns());
  msg.info.height = static_cast<std::uint32_t>(box.rows());
  msg.info.origin.position.x = grid.cell_m * box.min.column;
  msg.info.origin.position.y = grid.cell_m * box.min.row;
  msg.info.origin.position.z = grid.ground_m;
  msg.info.origin.orientation.w = 1.0;
  msg.data.reserve(static_cast<std::size_t>(box.columns()) * static_cast<std::size_t>(box.rows()));
  grid.cells.forEach([&](Cell cell) { msg.data.push_back(grid.cells[cell]); });
  return msg;
}

VoxelCloud::Ptr occupiedCentres(const OccupancyMap& map) {
  VoxelCloud::Ptr cloud(new VoxelCloud);
  map.forEachKnown([&](const Voxel& voxel, bool is_occupied) {
    if (!is_occupied) return;
    const Eigen::Vector3f centre = map.centreOf(voxel).cast<float>();
    cloud->push_back(pcl::PointXYZ(centre.x(), centre.y(), centre.z()));
  });
  return cloud;
}

}  // namespace mrpt_sgraphs
