// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "mrpt_sgraphs/io/building_file.h"
#include "mrpt_sgraphs/io/map_error.h"
#include "mrpt_sgraphs/io/pcd_reader.h"
#include "random_walk.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::messageOf;
using test::TemporaryFolder;

/// A wall 4 m long and 3 m high in the plane y = 1, with a door from x = 1 to x = 2, 2 m high.
FlatSurface wallWithDoor() {
  return FlatSurface({{0, 1, 0}, {4, 1, 0}, {4, 1, 3}, {0, 1, 3}},
                     {{{1, 1, 0}, {2, 1, 0}, {2, 1, 2}, {1, 1, 2}}});
}

TEST(FlatSurface, MeasuresToTheNearestPointOfIt) {
  const FlatSurface wall = wallWithDoor();
  EXPECT_NEAR(wall.distance({3.0, 1.0, 1.0}), 0.0, 1e-12);  // on it
  EXPECT_NEAR(wall.distance({3.0, 1.2, 1.0}), 0.2, 1e-12);  // before it
  EXPECT_NEAR(wall.distance({3.0, 0.8, 1.0}), 0.2, 1e-12);  // behind it
  EXPECT_NEAR(wall.distance({7.0, 5.0, 1.0}), 5.0, 1e-12);  // beside it: 3, 4, 5
  EXPECT_NEAR(wall.distance({1.5, 1.0, 1.0}), 0.5, 1e-12);  // in the door
  EXPECT_NEAR(wall.distance({1.5, 1.3, 1.6}), 0.5, 1e-12);  // before the door: 0.3, 0.4, 0.5
  EXPECT_NEAR(wall.distance({1.5, 1.0, 2.5}), 0.0, 1e-12);  // over the door
}

TEST(FlatSurface, IsNeverNearerThanItsBox) {
  const FlatSurface wall = wallWithDoor();
  for (const StampedPose& pose : test::walk(400)) {
    const Eigen::Vector3d point = pose.T_world_body.translation();
    EXPECT_LE(wall.distanceToBox(point), wall.distance(point) + 1e-12);
  }
}

TEST(FlatSurface, RefusesAnOutlineWithoutArea) {
  EXPECT_THROW(FlatSurface({{0, 0, 0}, {1, 0, 0}}, {}), std::invalid_argument);
  EXPECT_THROW(FlatSurface({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}), std::invalid_argument);
}

TEST(MapError, IsTheDistanceInTheTruthsFrame) {
  std::vector<Eigen::Vector3f> points_map;
  const Pose T_truth_map = test::someMotion();
  for (int k = 0; k < 1000; ++k) {
    // 1 cm off the wall, every fifth 50 cm
    const double offset_m = k % 5 == 0 ? 0.5 : 0.01;
    const Eigen::Vector3d point_truth(2.2 + 0.0015 * k, 1.0 + offset_m, 1.5);
    points_map.push_back((T_truth_map.inverse() * point_truth).cast<float>());
  }
  const MapError error = evaluateMap({wallWithDoor()}, points_map, T_truth_map);
  EXPECT_EQ(error.points, 1000u);
  EXPECT_NEAR(error.median_m, 0.01, 1e-4);
  EXPECT_NEAR(error.p90_m, 0.5, 1e-4);
}

TEST(MapError, ReadsWallsFloorsAndCeilingsOfABuilding) {
  const TemporaryFolder folder;
  const std::string path = folder.write("building.json", R"({
    "walls": [{"polygon": [[0,0,0],[4,0,0],[4,0,3],[0,0,3]], "holes": []}],
    "rooms": [{"polygon": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]], "height": 3.0}]})");
  const std::vector<FlatSurface> surfaces = readBuilding(path).surfaces;
  ASSERT_EQ(surfaces.size(), 3u);
  EXPECT_NEAR(surfaces[0].distance({2, 1, 1}), 1.0, 1e-12);
  EXPECT_NEAR(surfaces[1].distance({2, 2, 1}), 1.0, 1e-12);
  EXPECT_NEAR(surfaces[2].distance({2, 2, 1}), 2.0, 1e-12);
}

TEST(MapError, NamesABuildingThatItCannotRead) {
  const TemporaryFolder folder;
  for (const char* text : {"not json", "{}", R"({"walls": [], "rooms": []})",
                           R"({"walls": [{"polygon": [[0, 0]]}], "rooms": []})"}) {
    const std::string path = folder.write("building.json", text);
    EXPECT_NE(messageOf<std::runtime_error>([&] { readBuilding(path); }).find(path),
              std::string::npos)
        << text;
  }
}

std::string bytes(std::initializer_list<float> values) {
  std::string result(values.size() * sizeof(float), '\0');
  std::memcpy(result.data(), values.begin(), result.size());
  return result;
}

TEST(Pcd, ReadsBinaryPointsAmongOtherFieldsAndDropsTheInvalid) {
  const TemporaryFolder folder;
  const std::string header =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS intensity x y z\nSIZE 4 4 4 4\nTYPE F F F F\n"
      "COUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA binary\n";
  const std::string path = folder.write(
      "map.pcd", header + bytes({9, 1, 2, 3}) + bytes({9, NAN, 2, 3}) + bytes({9, 4, 5, 6}));
  const auto points = readPcd(path);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(points[1], Eigen::Vector3f(4, 5, 6));

  folder.write("map.pcd", header + bytes({9, 1, 2, 3}) + bytes({9, 4}));
  const std::string message = messageOf<std::runtime_error>([&] { readPcd(path); });
  EXPECT_NE(message.find("it ends at point 2 of 3"), std::string::npos) << message;
}

TEST(Pcd, ReadsText) {
  const TemporaryFolder folder;
  const auto points = readPcd(folder.write("map.pcd",
                                           "FIELDS x y z label\nSIZE 4 4 4 2\nTYPE F F F U\nPOINTS "
                                           "2\nDATA ascii\n1 2 3 7\n4 5 nan 7\n"));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], Eigen::Vector3f(1, 2, 3));
}

TEST(Pcd, NamesAFileThatItCannotRead) {
  const TemporaryFolder folder;
  for (const char* text : {"", "FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n",
                           "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n",
                           "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA odd\n1 2 3\n",
                           "FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n"}) {
    const std::string path = folder.write("map.pcd", text);
    EXPECT_NE(messageOf<std::runtime_error>([&] { readPcd(path); }).find(path), std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
