// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/map_cloud_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mapping/map_world.h"
#include "mrpt_sgraphs/io/pcd_reader.h"
#include "mrpt_sgraphs/mapping/coloured_map.h"
#include "mrpt_sgraphs/mapping/map_cloud.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::roomOf6by4;
using test::TemporaryFolder;
using test::walkThrough;

/// A room of which the west half is one room of the graph, and keyframes on two floors.
GraphSnapshot halfARoom() {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 4);
  for (std::size_t k = 0; k < 4; ++k) graph.keyframes.edit(k).floor = FloorId{k < 3 ? 0U : 1U};
  for (uint64_t id = 0; id < 2; ++id) {
    FloorNode floor;
    floor.id = FloorId{id};
    floor.name = id == 0 ? "ground" : "";
    graph.floors.push_back(floor);
  }
  RoomNode room;
  room.id = RoomId{5};
  room.T_map_room.translation() << 1.5, 2.0, 0.0;
  room.extent_map.outline = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
  room.height_m = 2.6;
  graph.rooms.push_back(room);
  return graph;
}

std::string refusalOf(const MapFileRequest& request) {
  try {
    writeMapCloud(halfARoom(), request);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MapByRooms, WallsHaveTheColourOfTheRoomThatTheyBound) {
  const auto map = mapByRooms(halfARoom(), 0.1);
  std::size_t coloured = 0;
  for (const pcl::PointXYZRGB& point : *map) {
    const bool is_grey = point.r == point.g && point.g == point.b;
    if (point.x < 2.7F) EXPECT_FALSE(is_grey) << point.x << ' ' << point.y << ' ' << point.z;
    if (point.x > 3.3F) EXPECT_TRUE(is_grey) << point.x << ' ' << point.y << ' ' << point.z;
    coloured += is_grey ? 0 : 1;
  }
  EXPECT_GT(coloured, 1000U);
  EXPECT_EQ(map->size(), mapCloud(halfARoom(), 0.1)->size());
}

TEST(MapCloudFile, IsPcdOrPlyByItsEnding) {
  const TemporaryFolder folder;
  const std::size_t points = mapCloud(halfARoom(), 0.2)->size();
  EXPECT_EQ(writeMapCloud(halfARoom(), {folder.file("map.pcd"), 0.2, "", false}), points);
  EXPECT_EQ(writeMapCloud(halfARoom(), {folder.file("map.ply"), 0.2, "", false}), points);
  EXPECT_EQ(readPcd(folder.file("map.pcd")).size(), points);
  const std::string ply = folder.read("map.ply");
  const std::size_t head = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.substr(0, 41), "ply\nformat binary_little_endian 1.0\neleme");
  EXPECT_EQ(ply.size() - head, 16 * points);
}

TEST(MapCloudFile, HasColours) {
  const TemporaryFolder folder;
  const auto points = mapByRooms(halfARoom(), 0.2);
  EXPECT_EQ(writeMapCloud(halfARoom(), {folder.file("map.pcd"), 0.2, "", true}), points->size());
  writeMapCloud(halfARoom(), {folder.file("map.ply"), 0.2, "", true});
  EXPECT_NE(folder.read("map.pcd").find("FIELDS x y z rgb\n"), std::string::npos);
  EXPECT_EQ(readPcd(folder.file("map.pcd")).size(), points->size());
  const std::string ply = folder.read("map.ply");
  const std::size_t head = ply.find("end_header\n") + 11;
  EXPECT_EQ(ply.size() - head, 15 * points->size());
  EXPECT_EQ(static_cast<uint8_t>(ply[head + 12]), (*points)[0].r);
  EXPECT_EQ(static_cast<uint8_t>(ply[head + 14]), (*points)[0].b);
}

TEST(MapCloudFile, IsOfOneFloorByNameOrId) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.pcd");
  const std::size_t all = writeMapCloud(halfARoom(), {path, 0.0, "", false});
  const std::size_t ground = writeMapCloud(halfARoom(), {path, 0.0, "ground", false});
  EXPECT_EQ(writeMapCloud(halfARoom(), {path, 0.0, "0", false}), ground);
  EXPECT_EQ(writeMapCloud(halfARoom(), {path, 0.0, "1", false}), all - ground);
}

TEST(MapCloudFile, WhatCannotBeIsRefusedAndNothingIsWritten) {
  const TemporaryFolder folder;
  EXPECT_NE(refusalOf({folder.file("map.txt"), 0.1, "", false}).find(".pcd or .ply"),
            std::string::npos);
  EXPECT_NE(refusalOf({folder.file("map.pcd"), -0.1, "", false}).find("resolution"),
            std::string::npos);
  EXPECT_NE(refusalOf({folder.file("map.pcd"), 0.1, "attic", false}).find("0 (ground), 1"),
            std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
  EXPECT_THROW(writeMapCloud(GraphSnapshot{}, {folder.file("map.pcd"), 0.1, "", false}),
               std::invalid_argument);
  EXPECT_THROW(writeMapCloud(halfARoom(), {"/proc/nowhere/map.pcd", 0.1, "", false}),
               std::runtime_error);
}

}  // namespace
}  // namespace mrpt_sgraphs
