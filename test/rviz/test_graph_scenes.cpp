// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "graph_messages.h"
#include "keyframe_scene.h"
#include "mrpt_sgraphs/mapping/node_colour.h"

namespace mrpt_sgraphs {
namespace {

const Eye kEye{{0.0, 0.0, 20.0}, 0.0};

std::shared_ptr<const GraphDrawing> drawingOf(const SituationalGraph& msg,
                                              const SceneOptions& options = {}) {
  return std::make_shared<GraphDrawing>(test::shown(msg), options);
}

GraphScene keyframesOf(const SituationalGraph& msg, const SceneOptions& options = {}) {
  return KeyframeScene(drawingOf(msg, options)).seenFrom(kEye);
}

GraphScene structureOf(const SituationalGraph& msg, const SceneOptions& options = {}) {
  return structureScene(*drawingOf(msg, options), kEye);
}

std::multiset<NodeId> nodesIn(const std::vector<PointSet>& sets) {
  std::multiset<NodeId> nodes;
  for (const PointSet& set : sets) {
    for (const PointSet::Point& point : set.points) nodes.insert(point.node);
  }
  return nodes;
}

std::set<NodeId> nodesIn(const AreaSet& set) {
  std::set<NodeId> nodes;
  for (const AreaSet::Triangle& triangle : set.triangles) nodes.insert(triangle.node);
  return nodes;
}

std::size_t linesIn(const GraphScene& scene) {
  return std::accumulate(
      scene.lines.begin(), scene.lines.end(), std::size_t{0},
      [](std::size_t sum, const LineSet& set) { return sum + set.lines.size(); });
}

/// How many lines of a scene join two places.
std::size_t linesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const GraphScene& scene) {
  const auto isAt = [](const Eigen::Vector3f& end, const Eigen::Vector3d& place) {
    return (end.cast<double>() - place).norm() < 1e-5;
  };
  std::size_t count = 0;
  for (const LineSet& set : scene.lines) {
    for (const LineSet::Line& line : set.lines) {
      if ((isAt(line.from, a) && isAt(line.to, b)) || (isAt(line.from, b) && isAt(line.to, a))) {
        ++count;
      }
    }
  }
  return count;
}

/// [m^2]
double areaOf(const AreaSet& set) {
  double sum = 0.0;
  for (const AreaSet::Triangle& triangle : set.triangles) {
    const auto& c = triangle.corners;
    sum += 0.5 * static_cast<double>((c[1] - c[0]).cross(c[2] - c[0]).norm());
  }
  return sum;
}

SituationalGraph rowOfKeyframes(int count) {
  SituationalGraph msg;
  msg.header.frame_id = "map";
  for (int k = 0; k < count; ++k) {
    GraphKeyframe keyframe;
    keyframe.id = keyframe.representative = static_cast<std::uint64_t>(k);
    keyframe.stamp = ros::Time(100.0 + k);
    keyframe.pose.orientation.w = keyframe.odom_pose.orientation.w = 1.0;
    keyframe.pose.position.x = 0.05 * k;
    keyframe.floor = keyframe.room = GraphKeyframe::NONE;
    msg.keyframes.push_back(keyframe);
    if (k == 0) continue;
    msg.factors.push_back(
        test::factorMsg("odometry", {KeyframeId{keyframe.id - 1}, KeyframeId{keyframe.id}}));
  }
  return msg;
}

TEST(ShownGraph, RefusesWhatIsNoGraph) {
  SituationalGraph msg = test::roomsMessage();
  msg.keyframes[0].pose.position.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(test::shown(msg), std::invalid_argument);
}

TEST(ShownGraph, LeavesOutTiesToWhatIsNotThere) {
  const auto graph = test::shown(test::roomsMessage());
  for (const Tie& tie : graph->ties) EXPECT_NE(tie.to.value, 77U);
  const auto condensed = std::count_if(graph->ties.begin(), graph->ties.end(), [](const Tie& tie) {
    return tie.kind == TieKind::kCondensed;
  });
  EXPECT_EQ(condensed, 2) << "a star around the kept keyframe";
}

TEST(GraphScenes, ShowEveryNodeOnceInItsLayer) {
  const SituationalGraph msg = test::roomsMessage();
  EXPECT_EQ(nodesIn(keyframesOf(msg).points),
            (std::multiset<NodeId>{KeyframeId{0}, KeyframeId{1}, KeyframeId{2}}));
  SceneOptions options;
  options.doorways = false;  // they pick their room
  const GraphScene structure = structureOf(msg, options);
  EXPECT_EQ(nodesIn(structure.points), (std::multiset<NodeId>{FloorId{0}, FloorId{1}}));
  EXPECT_EQ(nodesIn(structure.areas[2]),
            (std::set<NodeId>{WallId{4}, WallId{9}, RoomId{2}, RoomId{5}}));
}

TEST(GraphScenes, TurnTheSidesOfBoxesOutwards) {
  const auto drawing = drawingOf(test::roomsMessage());
  const GraphScene scene = structureScene(*drawing, kEye);
  double area_m2 = 0.0;
  for (const AreaSet::Triangle& triangle : scene.areas[2].triangles) {
    const auto& c = triangle.corners;
    const Eigen::Vector3f centre = drawing->places.find(triangle.node)->cast<float>();
    const Eigen::Vector3f normal = (c[1] - c[0]).cross(c[2] - c[0]);
    EXPECT_GT(normal.dot(c[0] - centre), 0.0F);
    area_m2 += 0.5 * static_cast<double>(normal.norm());
  }
  EXPECT_NEAR(area_m2, 2.0 * 6.0 * 1.0 + 2.0 * 6.0 * 0.2 * 0.2, 1e-4);
}

TEST(GraphScenes, LiftEachLayerAboveTheOneBelow) {
  SceneOptions flat;
  flat.layer_lift_m = 0.0;
  SceneOptions lifted;
  lifted.layer_lift_m = 8.0;
  const SituationalGraph msg = test::roomsMessage();
  const GraphScene below = structureOf(msg, flat);
  const GraphScene above = structureOf(msg, lifted);
  for (std::size_t set = 0; set < below.points.size(); ++set) {
    for (std::size_t k = 0; k < below.points[set].points.size(); ++k) {
      const PointSet::Point& point = below.points[set].points[k];
      const float layers = static_cast<float>(point.node.layer);
      EXPECT_NEAR(above.points[set].points[k].at.z() - point.at.z(), 8.0F * layers, 1e-5F);
    }
  }
  for (std::size_t set = 0; set < below.areas.size(); ++set) {
    ASSERT_EQ(above.areas[set].triangles.size(), below.areas[set].triangles.size());
    const auto& triangle = below.areas[set].triangles.front();
    const float layers = static_cast<float>(triangle.node.layer);
    EXPECT_NEAR(above.areas[set].triangles.front().corners[0].z() - triangle.corners[0].z(),
                8.0F * layers, 1e-5F);
  }
}

TEST(GraphScenes, FillWallsWithoutDoorsAndRoomsWithoutHoles) {
  const GraphScene scene = structureOf(test::roomsMessage());
  ASSERT_EQ(scene.areas.size(), 3U);
  EXPECT_NEAR(areaOf(scene.areas[0]), 4.0 * 2.5 - 1.0 * 2.0, 1e-4);
  EXPECT_NEAR(areaOf(scene.areas[1]), (4.0 * 4.0 - 1.0) + 2.0 * 10.0, 1e-4);
}

TEST(GraphScenes, TurnWallsToWhereTheyWereSeenFrom) {
  const GraphScene scene = structureOf(test::roomsMessage());
  for (const AreaSet::Triangle& triangle : scene.areas[0].triangles) {
    const auto& c = triangle.corners;
    EXPECT_LT((c[1] - c[0]).cross(c[2] - c[0]).x(), 0.0F) << "the wall's normal is -x";
  }
}

TEST(GraphScenes, TieWhatFactorsTie) {
  const SituationalGraph msg = test::roomsMessage();
  const auto drawing = drawingOf(msg);
  const auto at = [&](NodeId node) { return *drawing->places.find(node); };
  const GraphScene scene = KeyframeScene(drawing).seenFrom(kEye);
  EXPECT_EQ(linesBetween(at(KeyframeId{0}), at(KeyframeId{1}), scene), 1U);
  EXPECT_EQ(linesBetween(at(KeyframeId{0}), at(WallId{4}), scene), 1U);
  EXPECT_EQ(linesBetween(at(KeyframeId{0}), at(WallId{9}), scene), 1U) << "by the condensed factor";
  EXPECT_EQ(linesBetween(at(KeyframeId{2}), at(WallId{4}), scene), 0U);
  EXPECT_EQ(linesBetween(at(KeyframeId{0}), at(KeyframeId{2}), scene), 2U)
      << "a loop closure and a condensed factor";
}

TEST(GraphScenes, ShowNothingOfALayerThatIsOff) {
  const SituationalGraph msg = test::roomsMessage();
  SceneOptions options;
  options.walls = false;
  EXPECT_EQ(linesIn(keyframesOf(msg, options)), 4U) << "two odometries, the loop, the condensed";
  EXPECT_TRUE(structureOf(msg, options).areas[0].triangles.empty());
  options.rooms = options.floors = options.keyframes = false;
  EXPECT_EQ(linesIn(structureOf(msg, options)) + linesIn(keyframesOf(msg, options)), 0U);
  EXPECT_TRUE(nodesIn(structureOf(msg, options).points).empty());
  EXPECT_TRUE(nodesIn(keyframesOf(msg, options).points).empty());
  EXPECT_TRUE(structureOf(msg, options).labels.empty());
}

TEST(GraphScenes, ShowNoLineToAMarginalizedKeyframeThatIsHidden) {
  SceneOptions options;
  options.dropped_keyframes = false;
  options.representatives = true;
  const auto drawing = drawingOf(test::roomsMessage(), options);
  const GraphScene scene = KeyframeScene(drawing).seenFrom(kEye);
  const Eigen::Vector3d hidden = *drawing->places.find(KeyframeId{1});
  for (const NodeId other : {NodeId(KeyframeId{0}), NodeId(KeyframeId{2}), NodeId(WallId{4})}) {
    EXPECT_EQ(linesBetween(hidden, *drawing->places.find(other), scene), 0U);
  }
  options.dropped_keyframes = true;
  EXPECT_EQ(linesBetween(hidden, *drawing->places.find(KeyframeId{0}),
                         keyframesOf(test::roomsMessage(), options)),
            2U)
      << "odometry, and what it moves with";
}

TEST(GraphScenes, AlwaysHaveTheSameSets) {
  const GraphScene some = structureOf(test::roomsMessage());
  const GraphScene none = structureOf(SituationalGraph());
  EXPECT_EQ(some.points.size(), none.points.size());
  EXPECT_EQ(some.lines.size(), none.lines.size());
  EXPECT_EQ(some.areas.size(), none.areas.size());
}

TEST(GraphScenes, NameRoomsAndFloorsAlsoThoseWithoutAName) {
  std::vector<std::string> names;
  for (const Label& label : structureOf(test::roomsMessage()).labels) names.push_back(label.text);
  EXPECT_EQ(names, (std::vector<std::string>{"room 2", "corridor 5", "ground", "floor 1"}));
}

TEST(GraphPalette, SaysWhereAndWhenANodeIs) {
  const auto graph = test::shown(test::roomsMessage());
  const GraphPalette by_room(*graph, ColourBy::kRoom);
  EXPECT_EQ(by_room.of(KeyframeId{0}), colourOf(RoomId{2}));
  EXPECT_EQ(by_room.of(WallId{4}), colourOf(RoomId{2}));
  EXPECT_NE(by_room.of(KeyframeId{2}), colourOf(RoomId{2})) << "it is in no room";
  const GraphPalette by_floor(*graph, ColourBy::kFloor);
  EXPECT_EQ(by_floor.of(WallId{4}), colourOf(FloorId{0}));
  EXPECT_EQ(by_floor.of(FloorId{1}), colourOf(FloorId{1}));
  const GraphPalette by_age(*graph, ColourBy::kAge);
  EXPECT_GT(by_age.of(KeyframeId{2}).x(), by_age.of(KeyframeId{0}).x()) << "from blue to yellow";
  EXPECT_LT(by_age.of(KeyframeId{2}).z(), by_age.of(KeyframeId{0}).z());
  EXPECT_EQ(by_age.of(WallId{4}), by_age.of(KeyframeId{0})) << "seen first by the first";
  const GraphPalette by_layer(*graph, ColourBy::kLayer);
  EXPECT_NE(by_layer.of(KeyframeId{1}), by_layer.of(KeyframeId{0})) << "it is marginalized";
}

TEST(KeyframeScene, ThinsAndStaysConnected) {
  const SituationalGraph msg = rowOfKeyframes(2000);  // 100 m
  KeyframeScene scene(drawingOf(msg));
  const GraphScene seen = scene.seenFrom({{50.0, 0.0, 200.0}, 0.0});
  EXPECT_EQ(scene.count(), 2000U);
  EXPECT_EQ(scene.shownCount(), seen.points[0].points.size());
  EXPECT_LT(scene.shownCount(), 200U);
  EXPECT_EQ(linesIn(seen), scene.shownCount() - 1) << "still one chain, each line once";
}

TEST(GraphScenes, LeaveOutlinesOfWhatIsFarInALargeGraph) {
  SceneOptions options;
  options.thin_above = 2;
  options.near_m = 5.0;
  const auto drawing = drawingOf(test::roomsMessage(), options);
  const Eye far{{1.0, 0.0, 200.0}, 0.0};
  const GraphScene structure = structureScene(*drawing, far);
  EXPECT_TRUE(structure.areas[0].triangles.empty() && structure.areas[1].triangles.empty());
  EXPECT_EQ(structure.lines[0].lines.size(), 4U + 4U) << "round the wall and round the door";
  const GraphScene keyframes = KeyframeScene(drawing).seenFrom(far);
  for (const LineSet& set : keyframes.lines) {
    for (const LineSet::Line& line : set.lines) EXPECT_LT(line.to.z(), 5.0F) << "no sightings";
  }
  const Eye near{drawing->places.lifted({2.0, 0.0, 1.0}, Layer::kWall), 0.0};
  EXPECT_FALSE(structureScene(*drawing, near).areas[0].triangles.empty());
}

TEST(KeyframeScene, ShowsTheNearestOfManySightings) {
  SituationalGraph msg = rowOfKeyframes(2000);
  GraphWall wall;
  wall.normal.y = 1.0;
  wall.distance = -4.0;
  wall.floor = GraphKeyframe::NONE;
  msg.walls.push_back(wall);
  for (std::uint64_t k = 0; k < 2000; ++k) {
    msg.factors.push_back(test::factorMsg("wall_observation", {KeyframeId{k}, WallId{0}}));
  }
  SceneOptions options;
  options.odometry = false;
  options.near_m = 60.0;
  const Eye eye{{0.0, 0.0, 1.0}, 0.0};
  const GraphScene nearest = KeyframeScene(drawingOf(msg, options)).seenFrom(eye);
  EXPECT_EQ(linesIn(nearest), 500U) << "of 1199 within 60 m";
  for (const LineSet& set : nearest.lines) {
    for (const LineSet::Line& line : set.lines) EXPECT_LT(line.from.x(), 25.0F);
  }
  options.thin_above = 2000;
  EXPECT_EQ(linesIn(KeyframeScene(drawingOf(msg, options)).seenFrom(eye)), 2000U);
}

TEST(KeyframeScene, ThinsNothingOfASmallGraph) {
  KeyframeScene scene(drawingOf(rowOfKeyframes(500)));
  const GraphScene seen = scene.seenFrom({{50.0, 0.0, 2000.0}, 0.0});
  EXPECT_EQ(scene.shownCount(), 500U);
  EXPECT_EQ(linesIn(seen), 499U);
}

TEST(KeyframeScene, ShowsAKeptKeyframeForMarginalizedOnes) {
  SituationalGraph msg = rowOfKeyframes(2000);
  for (GraphKeyframe& keyframe : msg.keyframes) {
    keyframe.marginalized = keyframe.id % 40 != 7;
    keyframe.representative = keyframe.id - (keyframe.id + 33) % 40;
    if (keyframe.id < 7) keyframe.representative = 7;
  }
  KeyframeScene scene(drawingOf(msg));
  const GraphScene seen = scene.seenFrom({{50.0, 0.0, 400.0}, 0.0});
  EXPECT_GT(seen.points[0].points.size(), seen.points[1].points.size());
}

TEST(KeyframeScene, LabelsTheNearestOnly) {
  SceneOptions options;
  options.keyframe_labels = true;
  KeyframeScene scene(drawingOf(rowOfKeyframes(900), options));
  const auto labels = scene.seenFrom({{0.0, 0.0, 1.0}, 0.0}).labels;
  ASSERT_EQ(labels.size(), 100U);
  EXPECT_EQ(labels.front().text, "0");
  for (const Label& label : labels) EXPECT_LT(label.at.x(), 5.01F);
}

}  // namespace
}  // namespace mrpt_sgraphs
