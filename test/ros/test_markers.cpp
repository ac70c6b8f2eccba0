// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "mrpt_sgraphs/mapping/wall_colour.h"
#include "mrpt_sgraphs/ros/markers.h"
#include "some_graph.h"

namespace mrpt_sgraphs {
namespace {

using visualization_msgs::Marker;

std::vector<Marker> markersOf(const GraphSnapshot& graph) {
  std::vector<Marker> markers = toMarkers(graph, "map").markers;
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

TEST(Markers, ShowAFloorAsASquareOnItsGroundAroundItsCentre) {
  const Marker floors = markerNamed("floors", markersOf(test::threeKeyframesBetweenWalls()));
  EXPECT_NEAR(areaOf(floors), 4.0, 1e-6);
  for (const auto& point : floors.points) {
    EXPECT_NEAR(point.z, -0.5, 1e-12);
    EXPECT_NEAR((at(point) - Eigen::Vector3d(1.0, 0.5, -0.5)).norm(), std::sqrt(2.0), 1e-9);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
