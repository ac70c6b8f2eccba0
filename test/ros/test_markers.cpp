// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/mapping/node_colour.h"
#include "mrpt_sgraphs/ros/markers.h"
#include "some_rooms.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

std::vector<Marker> markersOf(const GraphSnapshot& graph, double layer_lift_m = 0.0,
                              const OptimizationSummary* optimization = nullptr) {
  std::vector<Marker> markers = toMarkers(graph, {"map", layer_lift_m}, optimization).markers;
  EXPECT_EQ(markers.front().action, int{Marker::DELETEALL}) << "what was shown before goes";
  markers.erase(markers.begin());
  for (const Marker& marker : markers) {
    EXPECT_EQ(marker.action, int{Marker::ADD});
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_TRUE(marker.colors.empty() || marker.colors.size() == marker.points.size());
  }
  return markers;
}

std::vector<std::string> namespacesOf(const std::vector<Marker>& markers) {
  std::vector<std::string> names;
  for (const Marker& marker : markers) names.push_back(marker.ns);
  return names;
}

Marker markerNamed(const std::string& name, const std::vector<Marker>& markers) {
  const auto found = std::find_if(markers.begin(), markers.end(),
                                  [&name](const Marker& marker) { return marker.ns == name; });
  EXPECT_NE(found, markers.end()) << name;
  return found == markers.end() ? Marker() : *found;
}

Eigen::Vector3d at(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

/// [m^2]
double areaOf(const Marker& triangles) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 2 < triangles.points.size(); k += 3) {
    const Eigen::Vector3d a = at(triangles.points[k]);
    sum += 0.5 * (at(triangles.points[k + 1]) - a).cross(at(triangles.points[k + 2]) - a).norm();
  }
  return sum;
}

TEST(Markers, ShowEachLayerInItsOwnNamespace) {
  const auto markers = markersOf(test::threeKeyframes());
  ASSERT_EQ(namespacesOf(markers),
            (std::vector<std::string>{"keyframes", "odometry", "loop_closures"}));
  EXPECT_EQ(markers[0].points.size(), 3U);
  EXPECT_EQ(markers[1].points.size(), 4U);
  EXPECT_EQ(markers[2].points.size(), 2U);
}

TEST(Markers, TieTheKeptKeyframeToWhatItsCondensedFactorHolds) {
  GraphSnapshot graph = test::threeKeyframesBetweenWalls();
  const std::vector<CondensedFactor::Other> others{
      {KeyframeId{2}, Pose::Identity()}, {WallId{4}, Plane{}}, {FloorId{0}, Plane{}}};
  const CondensedFactor::Quadratic quadratic{Eigen::MatrixXd::Identity(12, 12),
                                             Eigen::VectorXd::Zero(12), 0.0};
  graph.factors.push_back(
      {FactorId{99}, std::make_shared<CondensedFactor>(KeyframeId{0}, others, quadratic)});
  const auto markers = markersOf(graph);
  const Marker condensed = markerNamed("condensed", markers);
  ASSERT_EQ(condensed.points.size(), 2U);
  EXPECT_EQ(at(condensed.points[0]), graph.keyframes[0].T_map_base.translation());
  EXPECT_EQ(at(condensed.points[1]), graph.keyframes[2].T_map_base.translation());
  const Marker sights = markerNamed("condensed_observations", markers);
  ASSERT_EQ(sights.points.size(), 2U) << "to the wall, and not to the floor";
  EXPECT_EQ(at(sights.points[1]), at(markerNamed("wall_ids", markers).pose.position));
}

TEST(Markers, OfAnEmptyGraphRemoveWhatWasShown) { EXPECT_TRUE(markersOf(GraphSnapshot()).empty()); }

TEST(Markers, ShowAWallAsItsExtentWithItsDoorInItsColour) {
  const auto markers = markersOf(test::threeKeyframesBetweenWalls());
  const Marker walls = markerNamed("walls", markers);
  EXPECT_EQ(walls.type, int{Marker::TRIANGLE_LIST});
  EXPECT_EQ(walls.points.size() % 3, 0U);
  EXPECT_NEAR(areaOf(walls), 4.0 * 2.5 - 1.0 * 2.0, 1e-6);
  const Eigen::Vector3f rgb = colourOf(WallId{4});
  for (const auto& point : walls.points) EXPECT_NEAR(point.x, 3.0, 1e-9);
  for (const auto& colour : walls.colors) {
    EXPECT_EQ(Eigen::Vector3f(colour.r, colour.g, colour.b), rgb);
    EXPECT_LT(colour.a, 1.0F);
  }
  EXPECT_LT(walls.color.a, 1.0F) << "rviz takes this one";
  const Marker outlines = markerNamed("wall_outlines", markers);
  EXPECT_EQ(outlines.points.size(), 2U * (4U + 4U)) << "round the wall and round the door";
}

TEST(Markers, NameEveryWallAlsoOneOfUnknownExtent) {
  std::vector<Marker> plates;
  for (const Marker& marker : markersOf(test::threeKeyframesBetweenWalls())) {
    if (marker.ns == "wall_ids") plates.push_back(marker);
  }
  ASSERT_EQ(plates.size(), 2U);
  EXPECT_EQ(plates[0].text, "4");
  EXPECT_EQ(plates[0].id, 4);
  // 10 m^2 around (0, 1.25) without 2 m^2 around (0.5, 1)
  EXPECT_NEAR((at(plates[0].pose.position) - Eigen::Vector3d(3.0, -0.125, 1.3125)).norm(), 0.0,
              1e-6);
  EXPECT_EQ(plates[1].text, "9");
  EXPECT_NEAR((at(plates[1].pose.position) - Eigen::Vector3d(0.0, 2.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(Markers, TieKeyframesToTheMiddleOfTheWallsThatTheySee) {
  const GraphSnapshot graph = test::threeKeyframesBetweenWalls();
  const auto markers = markersOf(graph);
  const Marker sights = markerNamed("wall_observations", markers);
  ASSERT_EQ(sights.points.size(), 4U) << "the one of the floor is no wall's";
  EXPECT_EQ(at(sights.points[0]), graph.keyframes[0].T_map_base.translation());
  EXPECT_EQ(at(sights.points[2]), graph.keyframes[1].T_map_base.translation());
  EXPECT_EQ(at(sights.points[1]), at(markerNamed("wall_ids", markers).pose.position));
}

/// Where each node is shown: of the markers that show nodes, in the order of the nodes.
std::vector<Eigen::Vector3d> placesIn(const std::string& name, const std::vector<Marker>& markers) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& point : markerNamed(name, markers).points) places.push_back(at(point));
  return places;
}

bool isAmong(const Eigen::Vector3d& point, const std::vector<Eigen::Vector3d>& places) {
  return std::any_of(places.begin(), places.end(), [&point](const Eigen::Vector3d& place) {
    return (place - point).norm() < 1e-9;
  });
}

/// In all lifts, so that an edge that forgets to lift one of its ends is found.
class LayeredMarkers : public ::testing::TestWithParam<double> {
 protected:
  LayeredMarkers() : markers_(markersOf(graph_, GetParam())) {
    for (const Marker& marker : markers_) {
      if (marker.ns == "wall_ids") walls_.push_back(at(marker.pose.position));
    }
    for (const char* name : {"keyframes", "marginalized_keyframes"}) {
      const auto places = placesIn(name, markers_);
      keyframes_.insert(keyframes_.end(), places.begin(), places.end());
    }
  }

  void expectEdges(const std::string& name, std::size_t edges,
                   const std::vector<Eigen::Vector3d>& from,
                   const std::vector<Eigen::Vector3d>& to) const {
    SCOPED_TRACE(name);
    const auto ends = placesIn(name, markers_);
    ASSERT_EQ(ends.size(), 2 * edges);
    for (std::size_t k = 0; k < ends.size(); k += 2) {
      EXPECT_TRUE(isAmong(ends[k], from)) << k;
      EXPECT_TRUE(isAmong(ends[k + 1], to)) << k;
    }
  }

  const GraphSnapshot graph_ = test::twoRoomsOnTwoFloors();
  const std::vector<Marker> markers_;
  std::vector<Eigen::Vector3d> walls_;
  std::vector<Eigen::Vector3d> keyframes_;
};

TEST_P(LayeredMarkers, EveryLayerIsALiftAboveTheOneBelow) {
  const Eigen::Vector3d lift = GetParam() * Eigen::Vector3d::UnitZ();
  const auto in_place = markersOf(graph_, 0.0);
  for (const auto& [name, layers] :
       std::vector<std::pair<const char*, int>>{{"keyframes", 0},
                                                {"marginalized_keyframes", 0},
                                                {"odometry", 0},
                                                {"walls", 1},
                                                {"wall_outlines", 1},
                                                {"rooms", 2},
                                                {"room_areas", 2},
                                                {"room_outlines", 2},
                                                {"doorways", 2},
                                                {"room_doorways", 2},
                                                {"floors", 3},
                                                {"floor_connections", 3}}) {
    SCOPED_TRACE(name);
    const auto before = placesIn(name, in_place);
    const auto after = placesIn(name, markers_);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
      EXPECT_NEAR((after[k] - before[k] - layers * lift).norm(), 0.0, 1e-9);
    }
  }
}

TEST_P(LayeredMarkers, EveryEdgeEndsAtItsNodes) {
  const auto rooms = placesIn("rooms", markers_);
  const auto floors = placesIn("floors", markers_);
  expectEdges("odometry", 2, keyframes_, keyframes_);
  expectEdges("loop_closures", 1, keyframes_, keyframes_);
  expectEdges("wall_observations", 2, keyframes_, walls_);
  expectEdges("room_walls", 3, rooms, walls_);
  expectEdges("room_doorways", 3, rooms, placesIn("doorways", markers_));
  expectEdges("floor_rooms", 2, floors, rooms);
}

TEST_P(LayeredMarkers, FromRoomToRoomByTheirDoorway) {
  const auto rooms = placesIn("rooms", markers_);
  const auto ends = placesIn("room_doorways", markers_);  // two of the first room, one of the other
  EXPECT_EQ(ends[0], rooms[0]);
  EXPECT_EQ(ends[4], rooms[1]);
  EXPECT_EQ(ends[1], ends[5]) << "both rooms know of it";
}

TEST_P(LayeredMarkers, FromFloorToFloorByTheirStairs) {
  const Eigen::Vector3d lift = 3.0 * GetParam() * Eigen::Vector3d::UnitZ();
  const auto floors = placesIn("floors", markers_);
  const auto way = placesIn("floor_connections", markers_);
  ASSERT_EQ(way.size(), 6U);
  EXPECT_EQ(way[0], floors[0]);
  EXPECT_EQ(way[1], Eigen::Vector3d(5.0, 4.0, -0.5) + lift);
  EXPECT_EQ(way[2], way[1]);
  EXPECT_EQ(way[3], Eigen::Vector3d(9.0, 4.0, 2.5) + lift);
  EXPECT_EQ(way[4], way[3]);
  EXPECT_EQ(way[5], floors[1]);
}

INSTANTIATE_TEST_SUITE_P(Lifts, LayeredMarkers, ::testing::Values(0.0, 8.0));

TEST(Markers, ShowMarginalizedKeyframesInRed) {
  const GraphSnapshot graph = test::twoRoomsOnTwoFloors();
  const auto markers = markersOf(graph);
  const Marker kept = markerNamed("keyframes", markers);
  const Marker dropped = markerNamed("marginalized_keyframes", markers);
  EXPECT_EQ(kept.points.size(), 2U);
  ASSERT_EQ(dropped.points.size(), 1U);
  EXPECT_EQ(at(dropped.points[0]), graph.keyframes[1].T_map_base.translation());
  EXPECT_EQ(kept.color.r + kept.color.g + kept.color.b, 0.0F);
  EXPECT_GT(dropped.color.r, 0.8F);
  EXPECT_LT(dropped.color.g + dropped.color.b, 0.4F);
  EXPECT_LT(dropped.scale.x, 0.8 * kept.scale.x);
}

TEST(Markers, BoxTheKeyframesOfTheLastOptimization) {
  const GraphSnapshot graph = test::twoRoomsOnTwoFloors();
  OptimizationSummary optimization;
  optimization.free_keyframes.add(KeyframeId{2});
  optimization.free_keyframes.add(KeyframeId{3});  // which is gone
  optimization.fixed_keyframes.add(KeyframeId{0});
  constexpr double kLift_m = 8.0;
  const auto markers = markersOf(graph, kLift_m, &optimization);
  const std::vector<std::pair<std::string, std::size_t>> boxes{{"free_keyframes", 2},
                                                               {"fixed_keyframes", 0}};
  for (const auto& [name, keyframe] : boxes) {
    SCOPED_TRACE(name);
    const auto corners = placesIn(name, markers);
    ASSERT_EQ(corners.size(), 2U * 12U) << "the edges of one cube";
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < corners.size(); k += 2) {
      EXPECT_NEAR((corners[k] - corners[k + 1]).norm(), 0.5, 1e-9);
      middle += (corners[k] + corners[k + 1]) / 24.0;
    }
    EXPECT_NEAR((middle - graph.keyframes[keyframe].T_map_base.translation()).norm(), 0.0, 1e-9);
  }
  const auto free = markerNamed("free_keyframes", markers).color;
  const auto fixed = markerNamed("fixed_keyframes", markers).color;
  EXPECT_GT(free.g, free.b);
  EXPECT_GT(fixed.b, fixed.g);
}

TEST(Markers, FillARoomsOutlineAndNotItsHoleInItsColour) {
  const auto markers = markersOf(test::twoRoomsOnTwoFloors());
  const Marker areas = markerNamed("room_areas", markers);
  EXPECT_NEAR(areaOf(areas), (4.0 * 4.0 - 1.0) + 2.0 * 10.0, 1e-6);
  EXPECT_LT(areas.color.a, 0.5F);
  const Eigen::Vector3f rgb = colourOf(RoomId{2});
  const Marker nodes = markerNamed("rooms", markers);
  for (const auto& colour : {areas.colors.front(), nodes.colors.front()}) {
    EXPECT_EQ(Eigen::Vector3f(colour.r, colour.g, colour.b), rgb);
  }
  EXPECT_EQ(markerNamed("room_outlines", markers).points.size(), 2U * (4U + 4U + 4U));
}

TEST(Markers, NameRoomsAndFloorsAlsoThoseWithoutAName) {
  std::vector<std::string> names;
  for (const Marker& marker : markersOf(test::twoRoomsOnTwoFloors())) {
    if (marker.ns == "room_names" || marker.ns == "floor_names") names.push_back(marker.text);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"room 2", "corridor 5", "ground", "floor 1"}));
}

}  // namespace
}  // namespace mrpt_sgraphs
