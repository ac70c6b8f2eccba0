// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/hierarchy/local_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "support/small_problem.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::size_t kWindow = 8;

/// The rounds of test::SmallWorld as a graph that grows keyframe by keyframe.
class LocalWindowTest : public ::testing::Test {
 protected:
  static constexpr int kKeyframes = 120;

  LocalWindowTest() {
    for (const Plane& wall : world_.walls) graph_.addWall(retract(wall, {0.01, -0.01, 0.05}), {});
  }

  void growTo(int keyframes) {
    for (; size_ < keyframes; ++size_) {
      const Pose T = world_.truth[static_cast<std::size_t>(size_)] * random_.smallPose(0.05, 0.01);
      KeyframeAttributes attributes;
      attributes.stamp_s = size_;
      graph_.addKeyframe(T, attributes);
      for (auto& factor : world_.factors) {
        if (factor != nullptr && lastKeyframeOf(*factor) == size_) {
          graph_.addFactor(FactorConstPtr(std::move(factor)));
        }
      }
    }
  }

  static int lastKeyframeOf(const Factor& factor) {
    int last = -1;
    for (int k = 0; k < factor.nodeCount(); ++k) {
      if (factor.node(k).layer == Layer::kKeyframe) {
        last = std::max(last, static_cast<int>(factor.node(k).value));
      }
    }
    return last;
  }

  /// The same free nodes, everything else fixed and every sighting for itself.
  Selection withoutSums(const Selection& window) const {
    Selection plain;
    plain.free = window.free;
    const std::set<NodeId> free(window.free.begin(), window.free.end());
    for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
      for (uint32_t slot = 0; slot < graph_.size(layer); ++slot) {
        const NodeId node = graph_.nodeAt({layer, slot});
        if (free.count(node) == 0) plain.fixed.push_back(node);
      }
    }
    return plain;
  }

  std::vector<double> optimized(const Selection& selection) {
    std::vector<NodeId> nodes = selection.free;
    const Problem::Values before = valuesOf(nodes);
    Optimizer optimizer;
    const OptimizerReport report = optimizeSelection(selection, {}, &optimizer, &graph_);
    EXPECT_TRUE(report.converged) << report.problem;
    EXPECT_TRUE(report.gauge.empty());
    std::vector<double> result{report.cost_before, report.cost_after};
    const Problem::Values after = valuesOf(nodes);
    for (const Pose& T : after.poses) {
      for (int k = 0; k < 12; ++k) result.push_back(T.matrix()(k % 3, k / 3));
    }
    for (const Plane& plane : after.planes) {
      result.insert(result.end(), {plane.normal.x(), plane.normal.y(), plane.normal.z(),
                                   plane.distance});
    }
    restore(nodes, before);
    return result;
  }

  Problem::Values valuesOf(const std::vector<NodeId>& nodes) const {
    Problem::Values values;
    for (const NodeId node : nodes) {
      if (isPlane(node.layer)) {
        values.planes.push_back(graph_.plane(graph_.handle(node)));
      } else {
        values.poses.push_back(graph_.pose(graph_.handle(node)));
      }
    }
    return values;
  }
  void restore(const std::vector<NodeId>& nodes, const Problem::Values& values) {
    std::size_t pose = 0;
    std::size_t plane = 0;
    for (const NodeId node : nodes) {
      if (isPlane(node.layer)) {
        graph_.setPlane(graph_.handle(node), values.planes[plane++]);
      } else {
        graph_.setPose(graph_.handle(node), values.poses[pose++]);
      }
    }
  }

  void expectSameAsWithoutSums(LocalWindow* window) {
    const Selection selection = window->select(graph_);
    const std::vector<double> summed = optimized(selection);
    const std::vector<double> plain = optimized(withoutSums(selection));
    ASSERT_EQ(summed.size(), plain.size());
    for (std::size_t k = 0; k < plain.size(); ++k) {
      EXPECT_NEAR(summed[k], plain[k], 1e-7 * (1.0 + std::abs(plain[k]))) << k;
    }
  }

  test::SmallWorld world_{kKeyframes};
  test::RandomGeometry random_{5};
  LayeredGraph graph_;
  int size_ = 0;
};

TEST_F(LocalWindowTest, FreesTheLastKeyframesAndWhatTheySee) {
  growTo(90);
  const Selection selection = LocalWindow(kWindow).select(graph_);
  std::set<NodeId> free(selection.free.begin(), selection.free.end());
  std::set<NodeId> expected;
  for (uint64_t k = 82; k < 90; ++k) expected.insert(KeyframeId{k});
  for (uint64_t w = 0; w < 4; ++w) expected.insert(WallId{w});
  EXPECT_EQ(free, expected);
  // the last one before, and the other ends of the loops of 84 and 88
  std::set<NodeId> fixed(selection.fixed.begin(), selection.fixed.end());
  EXPECT_EQ(fixed, (std::set<NodeId>{KeyframeId{44}, KeyframeId{48}, KeyframeId{81}}));
  EXPECT_EQ(selection.sums.size(), 4U);
}

TEST_F(LocalWindowTest, SumsSayTheSameAsTheSightingsThemselves) {
  growTo(90);
  LocalWindow window(kWindow);
  expectSameAsWithoutSums(&window);
}

TEST_F(LocalWindowTest, SumsThatGrowWithTheGraphAreThoseFromTheStart) {
  LocalWindow window(kWindow);
  for (int k = 2; k <= kKeyframes; ++k) {
    growTo(k);
    const Selection selection = window.select(graph_);
    Optimizer optimizer;
    optimizeSelection(selection, {}, &optimizer, &graph_);
    if (k % 10 == 0) expectSameAsWithoutSums(&window);
  }
  const std::vector<double> grown = optimized(window.select(graph_));
  LocalWindow afresh(kWindow);
  const std::vector<double> summed = optimized(afresh.select(graph_));
  for (std::size_t k = 0; k < grown.size(); ++k) EXPECT_NEAR(grown[k], summed[k], 1e-8);
}

TEST_F(LocalWindowTest, DoesNotMoveWhatIsBehindItByOneBit) {
  growTo(90);
  std::vector<Pose> before;
  for (uint64_t k = 0; k < 82; ++k) before.push_back(graph_.pose(KeyframeId{k}));
  LocalWindow window(kWindow);
  Optimizer optimizer;
  optimizeSelection(window.select(graph_), {}, &optimizer, &graph_);
  for (uint64_t k = 0; k < 82; ++k) {
    EXPECT_EQ(graph_.pose(KeyframeId{k}).matrix(), before[k].matrix());
  }
}

TEST_F(LocalWindowTest, NoticesFactorsThatComeLateAndNodesThatGo) {
  growTo(90);
  LocalWindow window(kWindow);
  window.select(graph_);
  // keyframe 5 turns out to have seen another wall, with a kernel, and keyframe 7 is erased
  const Plane seen = world_.truth[5].inverse() * world_.walls[0];
  graph_.addFactor(std::make_shared<PlaneObservationFactor>(
      KeyframeId{5}, WallId{0}, retract(seen, {0.0, 0.0, 0.2}), Eigen::Matrix3d::Identity() * 1e6));
  expectSameAsWithoutSums(&window);
  graph_.eraseNode(KeyframeId{7});
  expectSameAsWithoutSums(&window);
}

TEST_F(LocalWindowTest, SumsAgainWhenTheGraphHasMoved) {
  growTo(90);
  LocalWindow window(kWindow);
  window.select(graph_);
  for (uint64_t k = 1; k < 82; ++k) {
    graph_.setPose(KeyframeId{k}, graph_.pose(KeyframeId{k}) * random_.smallPose(0.05, 0.01));
  }
  window.forget();
  expectSameAsWithoutSums(&window);
}

TEST_F(LocalWindowTest, HoldsTheFirstKeyframeWhereThereIsNothingElse) {
  growTo(5);
  const Selection selection = LocalWindow(kWindow).select(graph_);
  EXPECT_EQ(selection.fixed, std::vector<NodeId>{KeyframeId{0}});
  LocalWindow window(kWindow);
  expectSameAsWithoutSums(&window);
  EXPECT_THROW(LocalWindow(0), std::invalid_argument);
  EXPECT_TRUE(LocalWindow(3).select(LayeredGraph()).free.empty());
}

TEST_F(LocalWindowTest, ARoomIsFreeAndItsOtherWallsStay) {
  growTo(90);
  const WallId unseen = graph_.addWall(world_.walls[0], {});
  const RoomId room = graph_.addRoom(Pose::Identity(), {});
  graph_.addFactor(std::make_shared<RoomCentreFactor>(
      room, WallId{1}, unseen, RoomCentreFactor::Information::Identity()));
  const Selection selection = LocalWindow(kWindow).select(graph_);
  EXPECT_EQ(std::count(selection.free.begin(), selection.free.end(), NodeId(room)), 1);
  EXPECT_EQ(std::count(selection.fixed.begin(), selection.fixed.end(), NodeId(unseen)), 1);
}

}  // namespace
}  // namespace mrpt_sgraphs
