// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/map_files.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "mapping/map_world.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::roomOf6by4;
using test::TemporaryFolder;
using test::walkThrough;

FloorGrid smallGrid() {
  FloorGrid grid;
  grid.cell_m = 0.1;
  grid.cells = CellGrid<std::int8_t>(CellBox{{-3, 5}, {0, 7}}, FloorGrid::kUnknown);
  grid.cells[{-3, 5}] = FloorGrid::kFree;
  grid.cells[{-2, 5}] = FloorGrid::kOccupied;
  grid.cells[{0, 7}] = FloorGrid::kOccupied;
  return grid;
}

TEST(GridFiles, AreAsMapServerWantsThem) {
  std::ostringstream pgm;
  writePgm(smallGrid(), pgm);
  const std::string grey(1, '\xCD'), black(1, '\0'), white(1, '\xFE');
  EXPECT_EQ(pgm.str(), "P5\n# 0.1 m a pixel\n4 3\n255\n" +                  //
                           grey + grey + grey + black + grey + grey + grey + grey +  // north up
                           white + black + grey + grey);
  std::ostringstream yaml;
  writeGridYaml(smallGrid(), "floor_0.pgm", yaml);
  EXPECT_EQ(yaml.str(),
            "image: floor_0.pgm\nresolution: 0.100000\norigin: [-0.300000, 0.500000, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(GridFiles, ComeBackAsTheyWere) {
  const TemporaryFolder folder;
  std::ostringstream pgm, yaml;
  writePgm(smallGrid(), pgm);
  folder.write("floor_0.pgm", pgm.str());
  writeGridYaml(smallGrid(), "floor_0.pgm", yaml);
  EXPECT_TRUE(readGrid(folder.write("floor_0.yaml", yaml.str())) == smallGrid());
}

TEST(GridFiles, OnesThatAreNoneAreRefusedByName) {
  const TemporaryFolder folder;
  std::ostringstream yaml;
  writeGridYaml(smallGrid(), "image.pgm", yaml);
  const std::string path = folder.write("grid.yaml", yaml.str());
  for (const char* image : {"", "P2\n4 3\n255\n", "P5\n4 3\n65535\n", "P5\n-4 3\n255\n",
                            "P5\n4 3\n255\nshort"}) {
    folder.write("image.pgm", image);
    try {
      readGrid(path);
      ADD_FAILURE() << image;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("image.pgm"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(readGrid(folder.file("missing.yaml")), std::runtime_error);
  EXPECT_THROW(readGrid(folder.write("empty.yaml", "{}")), std::runtime_error);
}

TEST(MapFiles, AreTheMapsOfTheGraph) {
  GraphSnapshot graph = walkThrough(roomOf6by4(), 5, 0.01);
  for (std::size_t k = 0; k < 5; ++k) graph.keyframes.edit(k).floor = FloorId{3};
  FloorNode floor;
  floor.id = FloorId{3};
  floor.ground_map = {Eigen::Vector3d::UnitZ(), 0.0};
  graph.floors.push_back(floor);
  const TemporaryFolder folder;
  const MapConfig config;
  writeMapFiles(folder.path(), graph, config);
  EXPECT_EQ(folder.entries(), 3);

  OccupancyMap map(config);
  map.update(graph);
  std::size_t occupied = 0;
  map.forEachKnown([&](const Voxel&, bool is_occupied) { occupied += is_occupied ? 1 : 0; });
  const auto centres = readOccupiedCells(folder.file("map.bt"));
  EXPECT_EQ(centres.size(), occupied);
  for (const Eigen::Vector3f& centre : centres) {
    const Eigen::Vector3f voxel = (centre.array() / 0.1F).floor();
    EXPECT_GT(map.evidenceAt({static_cast<int>(voxel.x()), static_cast<int>(voxel.y()),
                              static_cast<int>(voxel.z())}), 0) << centre.transpose();
  }
  const FloorGrid grid = readGrid(folder.file("floor_3.yaml"));
  const FloorGrid expected = floorGrids(map, graph, config).at(0);
  ASSERT_TRUE(grid.cells.box().min == expected.cells.box().min);
  ASSERT_TRUE(grid.cells.box().max == expected.cells.box().max);
  grid.cells.forEach([&](Cell cell) { EXPECT_EQ(grid.cells[cell], expected.cells[cell]); });
}

TEST(MapFiles, WhatIsNoOctoMapIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(readOccupiedCells(folder.write("map.bt", "nothing")), std::runtime_error);
  EXPECT_THROW(readOccupiedCells(folder.file("missing.bt")), std::runtime_error);
}

}  // namespace
}  // namespace mrpt_sgraphs
