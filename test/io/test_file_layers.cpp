// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "graph_files.h"
#include "mrpt_sgraphs/io/file_layers.h"

namespace mrpt_sgraphs::test {
namespace {

TEST(FileLayers, HaveTheFilesIdsAndMemberships) {
  const TemporaryFolder folder;
  const LayeredGraph graph = layersOf(readGraphFile(folder.write("a.sg", kSmallSg)));
  EXPECT_EQ(graph.size(Layer::kKeyframe), 2U);
  EXPECT_EQ(graph.size(Layer::kWall), 4U);
  EXPECT_EQ(graph.factorCount(), 5U);
  EXPECT_EQ(graph.attributes(KeyframeId{0}).room, RoomId{1});
  EXPECT_EQ(graph.attributes(KeyframeId{1}).room, std::nullopt);
  EXPECT_EQ(graph.attributes(KeyframeId{1}).floor, FloorId{0});
  EXPECT_EQ(graph.pose(KeyframeId{1}).translation(), Eigen::Vector3d(1.1, 0.0, 0.5));
  const RoomAttributes& room = graph.attributes(RoomId{1});
  EXPECT_EQ(room.walls, (std::vector<WallId>{{4}, {5}, {6}, {7}}));
  EXPECT_EQ(room.floor, FloorId{0});
}

TEST(FileLayers, RoomsLieOnTheirFloorAndHeadIntoThemselves) {
  const TemporaryFolder folder;
  const LayeredGraph graph = layersOf(readGraphFile(folder.write("a.sg", kSmallSg)));
  EXPECT_EQ(graph.plane(FloorId{0}).distance, 0.5);  // of the keyframes
  const Pose T_map_room = graph.pose(RoomId{1});
  EXPECT_EQ(T_map_room.translation(), Eigen::Vector3d(0.5, 0.0, 0.5));
  // the first wall looks back along x, from its inside
  EXPECT_LT((T_map_room.linear().col(0) + Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((T_map_room.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace mrpt_sgraphs::test
