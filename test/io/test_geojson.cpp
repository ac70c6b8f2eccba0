// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/geojson.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "support/small_building.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;

Json written(const GraphSnapshot& graph) {
  std::ostringstream out;
  writeGeoJson(graph, out);
  return Json::parse(out.str());
}

std::vector<Json> ofKind(const Json& document, const std::string& kind) {
  std::vector<Json> found;
  for (const Json& feature : document["features"]) {
    if (feature["properties"]["kind"] == kind) found.push_back(feature);
  }
  return found;
}

/// Positive if it goes counter-clockwise.
double areaOf(const Json& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    twice += ring[k][0].get<double>() * ring[k + 1][1].get<double>() -
             ring[k + 1][0].get<double>() * ring[k][1].get<double>();
  }
  return 0.5 * twice;
}

TEST(GeoJson, HasTheStructureOfRfc7946AndSaysThatItIsPlanar) {
  const Json document = written(*test::SmallBuilding().snapshot());
  EXPECT_EQ(document["type"], "FeatureCollection");
  EXPECT_FALSE(document.contains("crs"));  // which the RFC has done away with
  EXPECT_NE(document["coordinates_of"].get<std::string>().find("metres"), std::string::npos);
  for (const Json& feature : document["features"]) {
    EXPECT_EQ(feature["type"], "Feature");
    EXPECT_TRUE(feature["properties"].is_object());
    EXPECT_TRUE(feature.contains("geometry"));
  }
}

TEST(GeoJson, RoomsAreClosedPolygonsWithTheirNamesAndFloors) {
  const auto rooms = ofKind(written(*test::SmallBuilding().snapshot()), "room");
  ASSERT_EQ(rooms.size(), 3U);
  const Json& ring = rooms[1]["geometry"]["coordinates"][0];
  EXPECT_EQ(ring.size(), 5U);
  EXPECT_EQ(ring.front(), ring.back());
  EXPECT_NEAR(areaOf(ring), 15.0, 1e-9);
  EXPECT_EQ(rooms[1]["properties"]["name"], test::SmallBuilding::kName);
  EXPECT_EQ(rooms[1]["properties"]["area_m2"], 15.0);
  EXPECT_EQ(rooms[1]["properties"]["floor"], 0);
  EXPECT_EQ(rooms[2]["properties"]["floor_name"], "floor 2");
}

TEST(GeoJson, OutlinesGoCounterClockwiseAndHolesClockwiseWhateverTheGraphHas) {
  test::SmallBuilding building;
  RoomAttributes room = building.graph.attributes(RoomId{0});
  std::reverse(room.extent_map.outline.begin(), room.extent_map.outline.end());
  room.extent_map.holes = {{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}};
  building.graph.setAttributes(RoomId{0}, room);
  const Json first = ofKind(written(*building.snapshot()), "room")[0];
  const Json& rings = first["geometry"]["coordinates"];
  EXPECT_NEAR(areaOf(rings[0]), 12.0, 1e-9);
  EXPECT_NEAR(areaOf(rings[1]), -1.0, 1e-9);
  EXPECT_EQ(first["properties"]["area_m2"], 11.0);
}

TEST(GeoJson, DoorsAreLinesAcrossTheOpeningAndEachIsThereOnce) {
  const auto doors = ofKind(written(*test::SmallBuilding().snapshot()), "door");
  ASSERT_EQ(doors.size(), 2U);
  EXPECT_EQ(doors[0]["properties"]["rooms"], Json({0, 1}));
  EXPECT_EQ(doors[0]["properties"]["width_m"], 1.0);
  const Json& line = doors[0]["geometry"]["coordinates"];
  EXPECT_EQ(line, Json({{4.0, 1.0, 0.0}, {4.0, 2.0, 0.0}}));
  EXPECT_EQ(doors[1]["properties"]["rooms"], Json({2, nullptr}));
  EXPECT_EQ(doors[1]["geometry"]["coordinates"][0][1], 3.0);  // along its own wall
}

TEST(GeoJson, WaysLeadFromRoomToRoomThroughTheDoorAndStairsFromFloorToFloor) {
  const Json document = written(*test::SmallBuilding().snapshot());
  const auto ways = ofKind(document, "way");
  ASSERT_EQ(ways.size(), 1U);
  EXPECT_EQ(ways[0]["geometry"]["coordinates"],
            Json({{2.0, 1.5, 0.0}, {4.0, 1.5, 0.0}, {6.7, 1.5, 0.0}}));
  EXPECT_EQ(ways[0]["properties"]["length_m"], 4.7);
  const auto stairs = ofKind(document, "stairs");
  ASSERT_EQ(stairs.size(), 1U);
  EXPECT_EQ(stairs[0]["properties"]["floors"], Json({0, 1}));
}

TEST(GeoJson, ARoomWithoutOutlineHasNoGeometryAndAnEmptyGraphNoFeatures) {
  LayeredGraph graph;
  EXPECT_TRUE(written(*graph.snapshot())["features"].empty());
  RoomAttributes bare;
  bare.name = "\xFF no utf-8";
  bare.doorways = {{std::nullopt, {1.0, 2.0, 0.0}, 0.9}};
  graph.addRoom(Pose::Identity(), bare);
  const Json document = written(*graph.snapshot());
  EXPECT_TRUE(ofKind(document, "room")[0]["geometry"].is_null());
  EXPECT_EQ(ofKind(document, "door").size(), 1U);
}

}  // namespace
}  // namespace mrpt_sgraphs
