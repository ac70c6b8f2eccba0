// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes in a row that see four walls and the ground, all with noise.
class OptimizeSelection : public ::testing::Test {
 protected:
  static constexpr uint64_t kKeyframes = 12;

  void SetUp() override {
    std::vector<Plane> planes;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d normal(std::cos(M_PI_2 * k), std::sin(M_PI_2 * k), 0.0);
      planes.push_back({normal, -20.0 + 3.0 * k});
      graph_.addWall(retract(planes.back(), random_.vector(0.05)), {});
    }
    const Plane ground;
    graph_.addFloor(retract(ground, random_.vector(0.05)), {});
    Pose T_map_last = Pose::Identity();
    for (uint64_t k = 0; k < kKeyframes; ++k) {
      Pose T_map_base = Pose::Identity();
      T_map_base.translation() << 0.9 * static_cast<double>(k), std::sin(static_cast<double>(k)),
          1.0;
      const KeyframeId id = graph_.addKeyframe(T_map_base * random_.smallPose(0.1, 0.03), {});
      const auto see = [&](NodeId surface, const Plane& plane_map) {
        const Plane noisy = retract(inverseTimes(T_map_base, plane_map), random_.vector(0.01));
        graph_.addFactor(std::make_shared<PlaneObservationFactor>(
            id, surface, noisy, 1e3 * Eigen::Matrix3d::Identity()));
      };
      for (uint64_t wall = 0; wall < 4; ++wall) see(WallId{wall}, planes[wall]);
      see(FloorId{0}, ground);
      if (k > 0) {
        graph_.addFactor(std::make_shared<RelativePoseFactor>(
            KeyframeId{k - 1}, id,
            T_map_last.inverse() * T_map_base * random_.smallPose(0.02, 0.01),
            1e3 * Matrix6::Identity()));
      }
      T_map_last = T_map_base;
    }
  }

  std::vector<NodeId> keyframes(uint64_t from, uint64_t to) const {
    std::vector<NodeId> nodes;
    for (uint64_t k = from; k < to; ++k) nodes.push_back(KeyframeId{k});
    return nodes;
  }
  static std::vector<NodeId> surfaces() {
    return {WallId{0}, WallId{1}, WallId{2}, WallId{3}, FloorId{0}};
  }
  static std::vector<NodeId> together(std::vector<NodeId> a, const std::vector<NodeId>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  /// Bit by bit, in the graph and in MRPT's network.
  static bool isSame(NodeId node, const LayeredGraph& a, const LayeredGraph& b) {
    const auto equal = [](const auto& x, const auto& y) {
      return std::memcmp(&x, &y, sizeof(x)) == 0;
    };
    if (isPlane(node.layer)) {
      const Plane p = a.plane(a.handle(node));
      const Plane q = b.plane(b.handle(node));
      return equal(p.normal, q.normal) && equal(p.distance, q.distance);
    }
    const Eigen::Matrix4d T = a.pose(a.handle(node)).matrix();
    const Eigen::Matrix4d S = b.pose(b.handle(node)).matrix();
    if (node.layer == Layer::kKeyframe) {
      const auto& in_a = a.network().nodes.at(node.value);
      const auto& in_b = b.network().nodes.at(node.value);
      const Eigen::Matrix3d R_a = in_a.getRotationMatrix().asEigen();
      const Eigen::Matrix3d R_b = in_b.getRotationMatrix().asEigen();
      EXPECT_EQ(in_a.x(), T(0, 3));
      EXPECT_EQ(R_a, (T.topLeftCorner<3, 3>()));
      if (!equal(R_a, R_b) || in_a.x() != in_b.x()) return false;
    }
    return equal(T, S);
  }

  /// What a selection does: those that are free move, all others stay.
  void expectMovesOnlyTheFree(const Selection& selection) {
    LayeredGraph before;
    for (uint32_t k = 0; k < graph_.size(Layer::kKeyframe); ++k) {
      before.addKeyframe(graph_.pose(NodeHandle{Layer::kKeyframe, k}), {});
    }
    for (uint32_t k = 0; k < graph_.size(Layer::kWall); ++k) {
      before.addWall(graph_.plane(NodeHandle{Layer::kWall, k}), {});
    }
    before.addFloor(graph_.plane(FloorId{0}), {});

    Optimizer optimizer;
    const OptimizerReport report = optimizeSelection(selection, {}, &optimizer, &graph_);
    EXPECT_TRUE(report.converged) << report.problem;
    EXPECT_LT(report.cost_after, report.cost_before);
    for (const NodeId node : together(keyframes(0, kKeyframes), surfaces())) {
      const bool free =
          std::find(selection.free.begin(), selection.free.end(), node) != selection.free.end();
      EXPECT_NE(isSame(node, graph_, before), free) << nameOf(node);
    }
  }

  test::RandomGeometry random_{7};
  LayeredGraph graph_;
};

TEST_F(OptimizeSelection, MovesAllButTheFirstKeyframeOfTheWholeGraph) {
  const Selection all = selectAll(graph_);
  EXPECT_EQ(all.fixed, keyframes(0, 1));
  EXPECT_EQ(all.free, together(keyframes(1, kKeyframes), surfaces()));
  expectMovesOnlyTheFree(all);
}

TEST_F(OptimizeSelection, MovesAWindowUnderWhatIsAroundIt) {
  expectMovesOnlyTheFree({keyframes(4, 8), together(surfaces(), {KeyframeId{3}, KeyframeId{8}})});
}

TEST_F(OptimizeSelection, MovesWallsUnderFixedKeyframes) {
  expectMovesOnlyTheFree({{WallId{1}, WallId{3}}, keyframes(0, kKeyframes)});
}

TEST_F(OptimizeSelection, TakesEachFactorOnceThatTouchesAFreeNode) {
  Optimizer optimizer;
  const Selection window{keyframes(4, 8), together(surfaces(), {KeyframeId{3}, KeyframeId{8}})};
  const OptimizerReport report = optimizeSelection(window, {}, &optimizer, &graph_);
  EXPECT_EQ(report.factors, 4 * 5 + 5);
  EXPECT_EQ(report.free_tangents, 4 * 6);
  Optimizer other;
  const OptimizerReport all = optimizeSelection(selectAll(graph_), {}, &other, &graph_);
  EXPECT_EQ(static_cast<std::size_t>(all.factors), graph_.factorCount());
}

TEST_F(OptimizeSelection, LeavesOutWhatReachesOutsideOnlyWhereItIsTold) {
  Selection window{keyframes(4, 8), surfaces()};
  const GraphSnapshotConstPtr before = graph_.snapshot();
  Optimizer optimizer;
  try {
    optimizeSelection(window, {}, &optimizer, &graph_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "keyframe 4 is joined by odometry to keyframe 3, not in the selection");
  }
  EXPECT_EQ(graph_.snapshot(), before);
  window.outside = Selection::Outside::kIsLeftOut;
  EXPECT_EQ(optimizeSelection(window, {}, &optimizer, &graph_).factors, 4 * 5 + 3);
}

TEST_F(OptimizeSelection, RefusesNodesThatAreTwiceOrNotThere) {
  Optimizer optimizer;
  const GraphSnapshotConstPtr before = graph_.snapshot();
  for (const Selection& twice : {Selection{{WallId{0}, WallId{0}}, keyframes(0, kKeyframes)},
                                 Selection{{WallId{0}}, {WallId{0}}}}) {
    EXPECT_THROW(optimizeSelection(twice, {}, &optimizer, &graph_), std::invalid_argument);
  }
  EXPECT_THROW(optimizeSelection({{WallId{9}}, {}}, {}, &optimizer, &graph_), std::out_of_range);
  EXPECT_EQ(graph_.snapshot(), before);
}

TEST_F(OptimizeSelection, HasNothingToDoForNoNodes) {
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection({}, {}, &optimizer, &graph_).converged);
  LayeredGraph empty;
  EXPECT_TRUE(optimizeSelection(selectAll(empty), {}, &optimizer, &empty).converged);
}

}  // namespace
}  // namespace mrpt_sgraphs
