// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>

#include "mrpt_sgraphs/semantics/floor_detector.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kBase_m = 0.6;  ///< Of the robot's base above what it stands on.

/// A graph of keyframes half a metre apart, levels and walls; all of it tilted and turned against
/// the map if told so.
class Walk {
 public:
  explicit Walk(const Pose& T_map_world = Pose::Identity()) : T_map_world_(T_map_world) {}

  FloorId addFloor(double height_m, const Eigen::Vector2d& centre = {0.0, 0.0}) {
    FloorNode floor;
    floor.id = FloorId{10 + graph_.floors.size()};
    floor.ground_map = T_map_world_ * Plane{Eigen::Vector3d::UnitZ(), height_m};
    floor.centre_map = T_map_world_ * Eigen::Vector3d(centre.x(), centre.y(), height_m);
    graph_.floors.push_back(floor);
    return floor.id;
  }

  void stand(const Eigen::Vector3d& ground, std::optional<FloorId> floor = {}) {
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{graph_.keyframes.size()};
    graph_.stamp_s = static_cast<double>(keyframe.id.value);
    keyframe.stamp_s = graph_.stamp_s;
    keyframe.floor = floor;
    keyframe.T_map_base =
        T_map_world_ * Pose(Eigen::Translation3d(ground + kBase_m * Eigen::Vector3d::UnitZ()));
    graph_.keyframes.push_back(keyframe);
    at_ = ground;
  }

  /// From where it is to a point, without the keyframe there. Those before it have the level.
  void goTo(const Eigen::Vector3d& ground, std::optional<FloorId> floor = {}) {
    const Eigen::Vector3d from = at_;
    const int steps = static_cast<int>(std::round((ground - from).head<2>().norm() / 0.5));
    for (int k = 0; k < steps; ++k) stand(from + (ground - from) * k / steps, floor);
    at_ = ground;
  }
  void startAt(const Eigen::Vector3d& ground) { at_ = ground; }

  WallId addWall(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bottom_m,
                 double top_m) {
    WallNode wall;
    wall.id = WallId{graph_.walls.size()};
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector3d normal(-along.y(), along.x(), 0.0);
    wall.plane_map = T_map_world_ * Plane{normal, normal.head<2>().dot(a)};
    for (const double z : {bottom_m, top_m}) {
      wall.extent_map.outline.push_back(T_map_world_ * Eigen::Vector3d(a.x(), a.y(), z));
      wall.extent_map.outline.push_back(T_map_world_ * Eigen::Vector3d(b.x(), b.y(), z));
    }
    graph_.walls.push_back(wall);
    return wall.id;
  }

  FloorDetection detect() const { return detectFloors(graph_, FloorDetectorConfig()); }
  uint64_t size() const { return graph_.keyframes.size(); }

  /// Of each keyframe, the number of its level among those that were added; -1: none.
  std::vector<int> levels() const {
    std::vector<int> result(graph_.keyframes.size(), -1);
    for (const DetectedFloor& floor : detect().floors) {
      for (const KeyframeId id : floor.keyframes) {
        EXPECT_EQ(result[id.value], -1) << "on two levels";
        result[id.value] = static_cast<int>(floor.id.value) - 10;
      }
    }
    return result;
  }

 private:
  Pose T_map_world_;
  GraphSnapshot graph_;
  Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
};

std::vector<int> runs(const std::vector<std::pair<int, int>>& counts) {
  std::vector<int> result;
  for (const auto& [count, level] : counts) result.insert(result.end(), count, level);
  return result;
}

/// 5 m on the ground, up stairs of 5 m to 3 m, and 5 m there.
Walk upTheStairs(const Pose& T_map_world = Pose::Identity()) {
  Walk walk(T_map_world);
  const FloorId ground = walk.addFloor(0.0, {2.5, 0.0});
  const FloorId upper = walk.addFloor(3.0, {12.5, 0.0});
  walk.goTo({5.0, 0.0, 0.0}, ground);
  walk.goTo({10.0, 0.0, 3.0});
  walk.goTo({15.0, 0.0, 3.0}, upper);
  return walk;
}

TEST(FloorDetector, FindsNothingWithoutAGround) {
  Walk walk;
  walk.goTo({5.0, 0.0, 0.0});
  const FloorDetection detection = walk.detect();
  EXPECT_TRUE(detection.floors.empty());
  EXPECT_TRUE(detection.connections.empty());
  EXPECT_EQ(detection.stamp_s, 9.0);
}

TEST(FloorDetector, StairsBelongToNoLevelAndJoinTwo) {
  const Walk walk = upTheStairs();
  EXPECT_EQ(walk.levels(), runs({{11, 0}, {9, -1}, {10, 1}}));  // the first still stands below
  const FloorDetection detection = walk.detect();
  ASSERT_EQ(detection.connections.size(), 1U);
  EXPECT_EQ(detection.connections[0].from, FloorId{10});
  EXPECT_EQ(detection.connections[0].to, FloorId{11});
  EXPECT_EQ(detection.connections[0].keyframes.size(), 9U);
  EXPECT_EQ(detection.connections[0].keyframes.front(), KeyframeId{11});
  EXPECT_TRUE(detection.same.empty());
}

TEST(FloorDetector, NeitherTheMapsTiltNorItsHeadingMatters) {
  Pose T_map_world = expPose((Tangent() << 3.0, -8.0, 1.0, 0.02, -0.025, 0.0).finished());
  T_map_world = T_map_world * expPose((Tangent() << 0, 0, 0, 0, 0, 2.1).finished());
  EXPECT_EQ(upTheStairs(T_map_world).levels(), upTheStairs().levels());
}

TEST(FloorDetector, WhoSeesAGroundFromTheStairsDoesNotStandOnIt) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  const FloorId upper = walk.addFloor(3.0);
  walk.goTo({5.0, 0.0, 0.0}, ground);
  walk.goTo({6.0, 0.0, 0.6}, ground);  // still looks down on it
  walk.goTo({10.0, 0.0, 3.0});
  walk.goTo({15.0, 0.0, 3.0}, upper);
  EXPECT_EQ(walk.levels(), runs({{11, 0}, {9, -1}, {10, 1}}));
}

TEST(FloorDetector, WhoDoesNotSeeTheGroundStandsOnItByHeight) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  walk.goTo({3.0, 0.0, 0.0});
  walk.goTo({6.0, 0.0, 0.0}, ground);
  walk.goTo({9.0, 0.0, 0.04});
  walk.goTo({12.0, 0.0, 0.0}, ground);
  walk.goTo({14.0, 0.0, -0.03});
  EXPECT_EQ(walk.levels(), runs({{28, 0}}));
}

TEST(FloorDetector, ALandingIsOnTheStairs) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  const FloorId upper = walk.addFloor(3.0);
  walk.goTo({5.0, 0.0, 0.0}, ground);
  walk.goTo({7.5, 0.0, 1.5});
  walk.goTo({9.0, 0.0, 1.5});
  walk.goTo({9.0, 1.5, 1.5});
  walk.goTo({6.5, 1.5, 3.0});
  walk.goTo({1.5, 1.5, 3.0}, upper);
  EXPECT_EQ(walk.levels(), runs({{11, 0}, {15, -1}, {10, 1}}));
  EXPECT_EQ(walk.detect().connections.size(), 1U);
}

TEST(FloorDetector, ARampBelongsToNoLevelFromItsFootToItsHead) {
  Walk walk;
  const FloorId low = walk.addFloor(0.0);
  const FloorId high = walk.addFloor(0.8);
  walk.goTo({5.0, 0.0, 0.0}, low);
  walk.goTo({15.0, 0.0, 0.8});  // 4 cm from keyframe to keyframe
  walk.goTo({20.0, 0.0, 0.8}, high);
  EXPECT_EQ(walk.levels(), runs({{12, 0}, {17, -1}, {11, 1}}));
  EXPECT_EQ(walk.detect().connections.size(), 1U);
}

TEST(FloorDetector, HalfAStoreyIsALevelButNotForWhoClimbsPastItsHeight) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  const FloorId half = walk.addFloor(1.5);
  const FloorId upper = walk.addFloor(3.0);
  walk.goTo({5.0, 0.0, 0.0}, ground);
  walk.goTo({7.5, 0.0, 1.5});
  walk.goTo({12.5, 0.0, 1.5}, half);
  walk.goTo({15.0, 0.0, 0.0});
  walk.goTo({20.0, 0.0, 0.0}, ground);
  walk.goTo({25.0, 0.0, 3.0});
  walk.goTo({30.0, 0.0, 3.0}, upper);
  EXPECT_EQ(walk.levels(), runs({{11, 0}, {4, -1}, {11, 1}, {4, -1}, {11, 0}, {9, -1}, {10, 2}}));
  const FloorDetection detection = walk.detect();
  ASSERT_EQ(detection.connections.size(), 3U);  // up and down again by different stairs
  EXPECT_EQ(detection.connections[1].from, half);
  EXPECT_EQ(detection.connections[1].to, ground);
  EXPECT_EQ(detection.connections[2].to, upper);
}

TEST(FloorDetector, TheSameStairsUpAndDownAreOneAndOthersAreOthers) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  const FloorId upper = walk.addFloor(3.0);
  for (int tour = 0; tour < 3; ++tour) {
    walk.startAt({0.0, 0.0, 0.0});
    walk.goTo({5.0, 0.0, 0.0}, ground);
    walk.goTo({10.0, 0.0, 3.0});
    walk.goTo({10.0, 20.0, 3.0}, upper);
    walk.goTo({5.0, 20.0, 0.0});
    walk.goTo({0.0, 20.0, 0.0}, ground);
    walk.goTo({0.0, 0.0, 0.0}, ground);
  }
  const FloorDetection detection = walk.detect();
  EXPECT_EQ(detection.floors.size(), 2U);
  ASSERT_EQ(detection.connections.size(), 2U);
  EXPECT_EQ(detection.connections[0].keyframes.size(), 27U);
  EXPECT_EQ(detection.connections[1].keyframes.size(), 27U);
  EXPECT_EQ(detection.connections[1].from, upper);
}

TEST(FloorDetector, LevelsOfOneHeightAreOneAndAStepIsNone) {
  for (const double step_m : {0.03, -0.03, 0.1, -0.1}) {
    SCOPED_TRACE(step_m);
    Walk walk;
    const FloorId first = walk.addFloor(0.0);
    const FloorId upper = walk.addFloor(3.0);
    const FloorId again = walk.addFloor(step_m, {20.0, 0.0});
    walk.goTo({5.0, 0.0, 0.0}, first);
    walk.goTo({10.0, 0.0, 3.0});
    walk.goTo({15.0, 0.0, 3.0}, upper);
    walk.goTo({20.0, 0.0, step_m});
    walk.goTo({25.0, 0.0, step_m}, again);
    const FloorDetection detection = walk.detect();
    if (std::abs(step_m) > 0.05) {
      EXPECT_TRUE(detection.same.empty());
      EXPECT_EQ(detection.floors.size(), 3U);
      continue;
    }
    ASSERT_EQ(detection.same.size(), 1U);
    EXPECT_EQ(detection.same[0], std::pair(first, again));
    ASSERT_EQ(detection.floors.size(), 2U);
    EXPECT_EQ(detection.floors[0].keyframes.back(), KeyframeId{walk.size() - 1});
    for (const DetectedConnection& connection : detection.connections) {
      EXPECT_TRUE(connection.from != again && connection.to != again);
    }
  }
}

TEST(FloorDetector, WhoStoopsStaysAndWhoClimbsAFewStepsDoesNot) {
  for (const auto& [height_m, level] : {std::pair{-0.25, 0}, {0.25, 0}, {1.2, -1}}) {
    SCOPED_TRACE(height_m);
    Walk walk;
    const FloorId ground = walk.addFloor(0.0);
    walk.goTo({5.0, 0.0, 0.0}, ground);
    walk.goTo({6.0, 0.0, height_m});
    walk.goTo({7.0, 0.0, 0.0});
    walk.goTo({10.0, 0.0, 0.0}, ground);
    EXPECT_EQ(walk.levels(), runs({{11, 0}, {3, level}, {6, 0}}));
    EXPECT_TRUE(walk.detect().connections.empty());
  }
}

TEST(FloorDetector, OneStillOnTheStairsIsOnNone) {
  Walk walk;
  const FloorId ground = walk.addFloor(0.0);
  walk.goTo({5.0, 0.0, 0.0}, ground);
  walk.goTo({8.0, 0.0, 1.8}, ground);
  EXPECT_EQ(walk.levels(), runs({{11, 0}, {5, -1}}));
}

TEST(FloorDetector, WallsAreOfTheStoreyThatFacesThem) {
  Walk walk = upTheStairs();
  walk.goTo({0.0, 0.0, 3.0}, FloorId{11});  // back above where it began
  const WallId low = walk.addWall({-1.0, 1.0}, {-1.0, -1.0}, 0.1, 2.6);
  const WallId high = walk.addWall({-1.0, 1.0}, {-1.0, -1.0}, 3.1, 5.4);
  const WallId lintel = walk.addWall({0.0, -2.0}, {4.0, -2.0}, 2.1, 2.7);
  walk.addWall({-1.0, -1.0}, {-1.0, 1.0}, 0.0, 2.6);  // turned away: nobody was there
  const FloorDetection detection = walk.detect();
  ASSERT_EQ(detection.floors.size(), 2U);
  EXPECT_EQ(detection.floors[0].walls, (std::vector<WallId>{low, lintel}));
  EXPECT_EQ(detection.floors[1].walls, (std::vector<WallId>{high}));
}

/// Wings of a house, half a storey apart: the walls of the lower one reach above the other's floor.
TEST(FloorDetector, WallsOfASplitLevelAreOfTheirOwnWing) {
  Walk walk;
  const FloorId low = walk.addFloor(0.0);
  const FloorId high = walk.addFloor(1.5);
  walk.goTo({6.0, 0.0, 0.0}, low);
  walk.goTo({8.5, 0.0, 1.5});
  walk.goTo({15.0, 0.0, 1.5}, high);
  const WallId of_low = walk.addWall({0.0, -2.0}, {6.0, -2.0}, 0.0, 2.8);
  const WallId end_of_low = walk.addWall({-1.0, 2.0}, {-1.0, -2.0}, 0.2, 2.8);
  const WallId of_high = walk.addWall({9.0, -2.0}, {15.0, -2.0}, 1.5, 4.2);
  const FloorDetection detection = walk.detect();
  EXPECT_EQ(detection.floors[0].walls, (std::vector<WallId>{of_low, end_of_low}));
  EXPECT_EQ(detection.floors[1].walls, (std::vector<WallId>{of_high}));
}

}  // namespace
}  // namespace mrpt_sgraphs
