// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/semantics/loop_closer.h"

#include <gtest/gtest.h>

#include "keyframes_of_a_walk.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {
namespace {

using test::KeyframeWithTruth;
using test::WalkErrors;

/// Adds to the graph that a walk makes, without any loop in it.
void add(const Keyframe& keyframe, LayeredGraph* graph) {
  KeyframeAttributes attributes;
  attributes.stamp_s = keyframe.stamp_s;
  attributes.T_odom_base = keyframe.T_odom_base;
  attributes.cloud = keyframe.cloud;
  const KeyframeId id = graph->addKeyframe(keyframe.T_odom_base, attributes);
  if (id.value == 0) return;
  const KeyframeId last{id.value - 1};
  graph->addFactor(std::make_shared<RelativePoseFactor>(
      last, id, graph->pose(last).inverse() * keyframe.T_odom_base,
      keyframe.covariance.inverse()));
}

/// The loops that are found when the keyframes come one by one.
std::vector<LoopClosure> loopsOf(const std::vector<KeyframeWithTruth>& walk,
                                 const LoopCloserConfig& config = {}) {
  LoopCloser closer(config);
  LayeredGraph graph;
  std::vector<LoopClosure> loops;
  for (const KeyframeWithTruth& step : walk) {
    add(step.keyframe, &graph);
    const GraphSnapshotConstPtr now = graph.snapshot();
    for (const LoopClosure& loop : closer.find(*now)) {
      EXPECT_EQ(loop.to, now->keyframes.back().id);
      EXPECT_LT(loop.from, loop.to);
      loops.push_back(loop);
    }
  }
  return loops;
}

class LoopCloserTest : public ::testing::Test {
 protected:
  std::vector<KeyframeWithTruth> round(const WalkErrors& errors = {}) const {
    return test::walk(stage_, test::roundOfTheSmallBuilding(), errors);
  }

  const test::ScanStage stage_{sim::test::shipped("small"), sim::lidarNamed("vlp16_sparse")};
};

TEST_F(LoopCloserTest, FindsReturnsAndMeasuresThem) {
  for (const WalkErrors& errors :
       {WalkErrors{}, WalkErrors{{0.3, 0.0, 0.0}, 0.0175}, WalkErrors{{-0.2, 0.25, 0.1}, -0.03},
        WalkErrors{{0.5, -0.3, 0.0}, 0.05, 0.04, 0.008}}) {
    SCOPED_TRACE(errors.drift_m.transpose());
    const auto walk = round(errors);
    const auto loops = loopsOf(walk);
    EXPECT_GE(loops.size(), 2U);
    for (const LoopClosure& loop : loops) {
      const Pose T_from_to = walk[loop.from.value].T_map_base.inverse() *
                             walk[loop.to.value].T_map_base;
      const Tangent error = local(T_from_to, loop.T_from_to);
      EXPECT_LT(error.head<3>().norm(), 0.04) << loop.from.value << " to " << loop.to.value;
      EXPECT_LT(error.tail<3>().norm(), 0.01) << loop.from.value << " to " << loop.to.value;
      // and is as good as it says
      EXPECT_LT(error.dot(loop.information * error), 22.5);
    }
  }
}

/// Clouds that were let go of are neither candidates nor parts of what is registered against.
TEST_F(LoopCloserTest, FindsReturnsToKeyframesThatHaveKeptTheirClouds) {
  const auto walk = round();
  for (const std::size_t every : {2U, 1U}) {
    LoopCloser closer{LoopCloserConfig{}};
    LayeredGraph graph;
    std::vector<LoopClosure> loops;
    for (std::size_t k = 0; k < walk.size(); ++k) {
      add(walk[k].keyframe, &graph);
      if (k > 0 && k % every == 0) {
        const KeyframeId last{k - 1};
        KeyframeAttributes attributes = graph.attributes(last);
        attributes.cloud.reset();
        graph.setAttributes(last, attributes);
      }
      for (const LoopClosure& loop : closer.find(*graph.snapshot())) {
        EXPECT_NE(graph.attributes(loop.from).cloud, nullptr);
        const Pose T_from_to =
            walk[loop.from.value].T_map_base.inverse() * walk[loop.to.value].T_map_base;
        EXPECT_LT(local(T_from_to, loop.T_from_to).head<3>().norm(), 0.04);
        loops.push_back(loop);
      }
      EXPECT_FALSE(closer.confirm(*graph.snapshot(), KeyframeId{every == 1 ? 0U : 1U},
                                  Pose::Identity()))
          << "no cloud, or the newest itself";
    }
    EXPECT_EQ(loops.empty(), every == 1) << "of all but the newest nothing is left";
  }
}

TEST_F(LoopCloserTest, LeavesNeighboursAlone) {
  const auto walk = round();
  LoopCloserConfig config;
  for (const LoopClosure& loop : loopsOf(walk, config)) {
    double way_m = 0.0;
    for (std::size_t k = loop.from.value; k < loop.to.value; ++k) {
      way_m += (walk[k + 1].T_map_base.translation() - walk[k].T_map_base.translation()).norm();
    }
    EXPECT_GT(way_m, config.min_path_m);
  }
  config.min_path_m = 100.0;
  EXPECT_TRUE(loopsOf(walk, config).empty()) << "the whole walk is shorter";
}

TEST_F(LoopCloserTest, SearchesNoOftenerThanItIsTold) {
  const auto walk = round();
  LoopCloserConfig config;
  config.min_interval_m = 0.0;
  const auto always = loopsOf(walk, config);
  config.min_interval_m = 5.0;
  const auto seldom = loopsOf(walk, config);
  EXPECT_LT(seldom.size(), always.size());
  for (std::size_t k = 1; k < seldom.size(); ++k) {
    EXPECT_GE(seldom[k].to.value - seldom[k - 1].to.value, 5U);  // a keyframe a metre, or less
  }
}

TEST_F(LoopCloserTest, DoesNothingWhenItIsOff) {
  LoopCloserConfig config;
  config.enabled = false;
  EXPECT_TRUE(loopsOf(round(), config).empty());
  EXPECT_TRUE(LoopCloser({}).find({}).empty());
}

TEST_F(LoopCloserTest, ConfirmsWhatOthersSayIfTheDriftMayBeThatLarge) {
  for (const double sigma_m : {0.04, 0.0005}) {
    SCOPED_TRACE(sigma_m);
    const auto walk = round({{0.5, -0.3, 0.0}, 0.05, sigma_m, 0.2 * sigma_m});
    LayeredGraph graph;
    for (const KeyframeWithTruth& step : walk) add(step.keyframe, &graph);
    const Pose T_first_last = walk.front().T_map_base.inverse() * walk.back().T_map_base;
    Tangent error;
    error << 0.15, -0.1, 0.0, 0.0, 0.0, 0.04;
    const auto loop =
        LoopCloser({}).confirm(*graph.snapshot(), KeyframeId{0}, retract(T_first_last, error));
    EXPECT_EQ(loop.has_value(), sigma_m > 0.01);
    if (loop) EXPECT_LT(local(T_first_last, loop->T_from_to).head<3>().norm(), 0.04);
  }
}

/// A robot that leaves the west room and comes to one that looks exactly the same.
class IdenticalRooms : public LoopCloserTest {
 protected:
  static constexpr std::size_t kInRoom = 4;

  /// @param apart_m   From room to room.
  /// @param sigma_m   Of the odometry, from keyframe to keyframe.
  std::vector<KeyframeWithTruth> walk(double apart_m, double sigma_m) const {
    WalkErrors errors;
    errors.sigma_m = sigma_m;
    errors.sigma_rad = 0.05 * sigma_m;
    auto keyframes = test::walk(
        stage_, {{2.0, 4.0}, {2.0, 5.0}, {3.0, 5.0}, {2.4, 4.0}, {2.4, 1.0}, {8.2, 1.0}}, errors);
    // once more what was seen in the room, some way off
    const Pose T_odom_second = Pose(Eigen::Translation3d(0.0, -apart_m, 0.0));
    for (std::size_t k = 0; k < kInRoom; ++k) {
      KeyframeWithTruth again = keyframes[k];
      again.keyframe.stamp_s = keyframes.back().keyframe.stamp_s + 1.0;
      again.keyframe.T_odom_base = T_odom_second * again.keyframe.T_odom_base;
      // the way back to the first of them is no jump
      again.keyframe.covariance = keyframes.back().keyframe.covariance;
      keyframes.push_back(again);
    }
    return keyframes;
  }
};

TEST_F(IdenticalRooms, EightMetresApartMakeNoLoop) { EXPECT_TRUE(loopsOf(walk(8.0, 0.01)).empty()); }

TEST_F(IdenticalRooms, WithinReachMakeNoLoopEither) {
  // near enough to be tried, and the clouds fit: it is the way between that speaks against it
  EXPECT_TRUE(loopsOf(walk(2.5, 0.01)).empty());
}

TEST_F(IdenticalRooms, MakeALoopOnceTheRobotMayHaveComeBack) {
  EXPECT_FALSE(loopsOf(walk(2.5, 0.3)).empty());
}

/// Two storeys of one plan: the second time round everything looks as it did the first time, and the
/// odometry leaves open whether the robot has climbed.
class TwoStoreys : public LoopCloserTest {
 protected:
  /// @return How many loops join keyframes of the two rounds.
  /// @param first     Of the first round, and of the second.
  /// @param climb_m   Between the rounds, as odometry has it.
  /// @param sigma_m   Of the odometry's height, from keyframe to keyframe.
  std::size_t loops(const std::optional<FloorId>& first, const std::optional<FloorId>& second,
                    double climb_m, double sigma_m, double storey_m = 3.0) const {
    LayeredGraph graph;
    const FloorId ground = graph.addFloor({Eigen::Vector3d::UnitZ(), -0.5}, {});
    const FloorId upper = graph.addFloor({Eigen::Vector3d::UnitZ(), storey_m - 0.5}, {});
    EXPECT_EQ(ground, FloorId{0});
    EXPECT_EQ(upper, FloorId{1});
    LoopCloser closer({});
    std::size_t count = 0;
    double stamp_s = 0.0;
    const KeyframeId second_round{round().size()};
    for (const bool again : {false, true}) {
      for (const KeyframeWithTruth& step : round()) {
        Keyframe keyframe = step.keyframe;
        keyframe.stamp_s = stamp_s += 1.0;
        keyframe.covariance(2, 2) = sigma_m * sigma_m;
        if (again) keyframe.T_odom_base.translation().z() += climb_m;
        add(keyframe, &graph);
        const KeyframeId id = graph.snapshot()->keyframes.back().id;
        KeyframeAttributes attributes = graph.attributes(id);
        attributes.floor = again ? second : first;
        graph.setAttributes(id, attributes);
        for (const LoopClosure& loop : closer.find(*graph.snapshot())) {
          if (loop.from < second_round && !(loop.to < second_round)) ++count;
        }
      }
    }
    return count;
  }
};

TEST_F(TwoStoreys, OnOneFloorTheSecondRoundClosesLoops) {
  EXPECT_GT(loops(FloorId{0}, FloorId{0}, 0.05, 0.02), 0U);
  EXPECT_GT(loops({}, {}, 0.05, 0.02), 0U);
}

TEST_F(TwoStoreys, AreNeverJoinedHoweverUncertainTheWay) {
  // far enough for either level's keyframes to be tried and to fit
  EXPECT_EQ(loops(FloorId{0}, FloorId{1}, 2.0, 0.5), 0U);
  EXPECT_GT(loops(FloorId{0}, FloorId{0}, 2.0, 0.5), 0U) << "the same, but for the floors";
}

TEST_F(TwoStoreys, ThatAreAStepApartMayBeOneThatDriftHasTornApart) {
  EXPECT_GT(loops(FloorId{0}, FloorId{1}, 0.1, 0.02, 0.1), 0U);
}

TEST_F(TwoStoreys, OfUnknownLevelGoUpOrDownByNoMoreThanTheWayLeavesOpen) {
  // within the gate of the closed loop, which is wider
  EXPECT_EQ(loops({}, FloorId{1}, 1.0, 0.03), 0U);
  EXPECT_GT(loops({}, FloorId{1}, 1.0, 0.3), 0U);
}

}  // namespace
}  // namespace mrpt_sgraphs
