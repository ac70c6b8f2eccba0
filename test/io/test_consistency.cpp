// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "compressed_walk.h"
#include "mrpt_sgraphs/io/consistency.h"

namespace mrpt_sgraphs {
namespace {

using Kind = RelativePoseFactor::Kind;
using test::CompressedWalk;

std::vector<const Factor*> factorsOf(const GraphSnapshot& graph) {
  std::vector<const Factor*> factors;
  for (const StoredFactor& stored : graph.factors) factors.push_back(stored.factor.get());
  return factors;
}

/// A marginal on a keyframe and a wall.
MarginalModel modelOf(const Eigen::MatrixXd& H, const Eigen::VectorXd& g) {
  MarginalModel model;
  model.tangents.add(KeyframeId{1});
  model.tangents.add(WallId{1});
  model.H = H;
  model.g = g;
  model.scales = Eigen::VectorXd::Ones(9);
  return model;
}

TEST(Divergence, OfAGaussianFromItselfIsNothing) {
  test::RandomGeometry random(1);
  const Eigen::MatrixXd A = test::randomInformation<9>(&random);
  const Divergence d = divergence(modelOf(A, A.col(3)), modelOf(A, A.col(3)));
  EXPECT_EQ(d.dof, 9);
  EXPECT_NEAR(d.compressed_to_full, 0.0, 1e-15);
  EXPECT_NEAR(d.full_to_compressed, 0.0, 1e-15);
  EXPECT_NEAR(d.smallest->ratio, 1.0, 1e-12);
  EXPECT_NEAR(d.largest->ratio, 1.0, 1e-12);
  EXPECT_EQ(d.undetermined_full + d.undetermined_compressed, 0);
}

TEST(Divergence, OfTwoGaussiansIsThatOfTheFormula) {
  test::RandomGeometry random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd A = test::randomInformation<9>(&random);
    const Eigen::MatrixXd B = test::randomInformation<9>(&random);
    const Eigen::VectorXd mean_a =
        Eigen::VectorXd::NullaryExpr(9, [&] { return random.number(1); });
    const Eigen::VectorXd mean_b =
        Eigen::VectorXd::NullaryExpr(9, [&] { return random.number(1); });
    const auto kl = [](const Eigen::MatrixXd& P, const Eigen::MatrixXd& Q,
                       const Eigen::VectorXd& d) {  // KL of information P from information Q
      return 0.5 * ((Q * P.inverse()).trace() - 9.0 + d.dot(Q * d) +
                    std::log(P.determinant() / Q.determinant()));
    };
    const Divergence got = divergence(modelOf(A, -A * mean_a), modelOf(B, -B * mean_b));
    const double expected = kl(B, A, mean_b - mean_a);
    const double reverse = kl(A, B, mean_b - mean_a);
    EXPECT_NEAR(got.compressed_to_full, expected, 1e-8 * expected);
    EXPECT_NEAR(got.full_to_compressed, reverse, 1e-8 * reverse);
  }
}

TEST(Divergence, FindsTheWorstDirectionOfAPosition) {
  // the position is known twice as well along a skew direction, the wall's distance three times
  // worse
  const Eigen::Vector3d n = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(9, 9);
  Eigen::MatrixXd B = A;
  B.topLeftCorner<3, 3>() += 3.0 * n * n.transpose();
  B(8, 8) = 1.0 / 9.0;
  const Divergence d =
      divergence(modelOf(A, Eigen::VectorXd::Zero(9)), modelOf(B, Eigen::VectorXd::Zero(9)));
  EXPECT_NEAR(d.smallest->ratio, 0.5, 1e-9);
  EXPECT_EQ(d.smallest->node, NodeId(KeyframeId{1}));
  EXPECT_NEAR(d.largest->ratio, 3.0, 1e-9);
  EXPECT_EQ(d.largest->node, NodeId(WallId{1}));
}

TEST(Divergence, WhatNeitherKnowsDoesNotCount) {
  test::RandomGeometry random(3);
  Eigen::MatrixXd A = test::randomInformation<9>(&random);
  // one skew direction of which nothing is known
  const Eigen::VectorXd v =
      Eigen::VectorXd::NullaryExpr(9, [&] { return random.number(1); }).normalized();
  const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(9, 9) - v * v.transpose();
  A = P * A * P;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(9);
  const Divergence same = divergence(modelOf(A, none), modelOf(A, none));
  EXPECT_NEAR(same.compressed_to_full, 0.0, 1e-4);
  EXPECT_EQ(same.undetermined_full, 1);
  EXPECT_EQ(same.undetermined_compressed, 1);

  const Eigen::MatrixXd known = A + v * v.transpose();
  const Divergence lost = divergence(modelOf(known, none), modelOf(A, none));
  EXPECT_EQ(lost.undetermined_full, 0);
  EXPECT_EQ(lost.undetermined_compressed, 1);
  EXPECT_GT(lost.compressed_to_full, 1e6);
  EXPECT_GT(lost.full_to_compressed, 1.0);
  EXPECT_TRUE(std::isfinite(lost.compressed_to_full));
}

TEST(Divergence, IsOfTheSameNodesOnly) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(9, 9);
  const MarginalModel model = modelOf(A, A.col(0));
  MarginalModel other = model;
  other.tangents.nodes[1] = WallId{2};
  EXPECT_THROW(divergence(model, other), std::invalid_argument);
  EXPECT_THROW(divergence(modelOf(-A, A.col(0)), model), std::runtime_error);
}

TEST(LinearModelTest, MarginalsAreThoseOfADenseMatrix) {
  const CompressedWalk walk;
  const GraphSnapshotConstPtr graph = walk.graph.snapshot();
  test::DenseProblem dense;
  for (const KeyframeNode& node : graph->keyframes) dense.values[node.id] = node.T_map_base;
  for (const WallNode& node : graph->walls) dense.values[node.id] = node.plane_map;
  for (const StoredFactor& stored : graph->factors) dense.factors.push_back(stored.factor);
  const test::Linearized all = dense.linearize();

  const LinearModel model(*graph, factorsOf(*graph), KeyframeId{0});
  const std::vector<NodeId> kept{WallId{2}, KeyframeId{3}, KeyframeId{6}, WallId{0}};
  const std::vector<NodeId> others{KeyframeId{1}, KeyframeId{2}, KeyframeId{4}, KeyframeId{5},
                                   WallId{1}};
  const test::Linearized expected =
      test::schurComplement(all, dense.rowsOf(kept), dense.rowsOf(others));
  const MarginalModel got = model.marginal(kept);
  EXPECT_EQ(got.tangents.nodes, kept);
  EXPECT_NEAR((got.H - expected.H).norm(), 0.0, 1e-8 * expected.H.norm());
  EXPECT_NEAR((got.g - expected.g).norm(), 0.0, 1e-8 * expected.g.norm());
  EXPECT_EQ(got.undetermined, 0);

  const test::Linearized of_one = test::schurComplement(
      all, dense.rowsOf({KeyframeId{5}}),
      dense.rowsOf({KeyframeId{1}, KeyframeId{2}, KeyframeId{3}, KeyframeId{4}, KeyframeId{6},
                    WallId{0}, WallId{1}, WallId{2}}));
  const Matrix6 covariance = of_one.H.inverse();
  const Matrix6 got_covariance = model.covariances({KeyframeId{5}})[0];
  EXPECT_NEAR((got_covariance - covariance).norm(), 0.0, 1e-7 * covariance.norm());
  EXPECT_THROW(model.covariances({KeyframeId{0}}), std::out_of_range);  // fixed
}

TEST(LinearModelTest, CountsWhatNothingDetermines) {
  CompressedWalk walk;
  const RoomId room = walk.graph.addRoom(Pose::Identity(), {});
  Matrix6 along = Matrix6::Zero();
  along(0, 0) = 10.0;
  walk.graph.addFactor(std::make_shared<RelativePoseFactor>(
      KeyframeId{0}, room, walk.graph.pose(KeyframeId{0}).inverse(), along, Kind::kRoom));
  const GraphSnapshotConstPtr graph = walk.graph.snapshot();
  const LinearModel model(*graph, factorsOf(*graph), KeyframeId{0});
  EXPECT_EQ(model.marginal({WallId{0}}).undetermined, 5);
  EXPECT_EQ(model.marginal({WallId{0}, room}).undetermined, 0);
}

TEST(Consistency, ExactCondensationLosesNothing) {
  for (const bool with_walls : {true, false}) {
    CompressedWalk walk(with_walls);
    const std::size_t factors = walk.graph.factorCount();
    walk.condense();
    const CompressionReport report = compareWithOriginal(*walk.graph.snapshot());
    EXPECT_EQ(report.full.keyframes, 7U);
    EXPECT_EQ(report.full.factors, factors);
    EXPECT_EQ(report.compressed.keyframes, 4U);
    EXPECT_EQ(report.compressed.factors, with_walls ? 2U + 12U + 1U : 3U);
    const Divergence& d = report.divergence;
    EXPECT_EQ(d.dof, with_walls ? 27 : 18);
    EXPECT_TRUE(report.lost.empty());
    EXPECT_LT(d.compressed_to_full, 1e-9);
    EXPECT_LT(d.full_to_compressed, 1e-9);
    EXPECT_NEAR(d.smallest->ratio, 1.0, 1e-7);
    EXPECT_NEAR(d.largest->ratio, 1.0, 1e-7);
    EXPECT_EQ(d.undetermined_full, 0);
    EXPECT_EQ(d.undetermined_compressed, 0);
  }
}

TEST(Consistency, WhatAllRoomsLeaveOpenIsNoLoss) {
  CompressedWalk walk;
  const RoomId room = walk.graph.addRoom(Pose::Identity(), {});
  Matrix6 along = Matrix6::Zero();
  along(0, 0) = 10.0;
  walk.graph.addFactor(std::make_shared<RelativePoseFactor>(
      KeyframeId{0}, room, walk.graph.pose(KeyframeId{0}).inverse(), along, Kind::kRoom));
  walk.graph.addFloor(Plane{}, {});  // nothing is said of it at all
  walk.condense();
  const Divergence d = compareWithOriginal(*walk.graph.snapshot()).divergence;
  EXPECT_EQ(d.dof, 27 + 6);
  EXPECT_EQ(d.undetermined_full, 5);
  EXPECT_EQ(d.undetermined_compressed, 5);
  EXPECT_LT(d.compressed_to_full, 1e-6);
}

/// A straight walk whose turns are known: four equal steps become one edge of their summed
/// information, which is right for none of them and 16 times what the four together tell.
TEST(Consistency, SummedInformationIsOverconfident) {
  CompressedWalk walk(false);
  LayeredGraph& graph = walk.graph;
  const GraphSnapshotConstPtr before = graph.snapshot();
  for (const StoredFactor& stored : before->factors) graph.eraseFactor(stored.id);
  Matrix6 step = Matrix6::Identity();
  step.diagonal().tail<3>().setConstant(1e10);
  const auto edge = [&](uint64_t from, uint64_t to, const Matrix6& information, Kind kind) {
    return graph.addFactor(std::make_shared<RelativePoseFactor>(
        KeyframeId{from}, KeyframeId{to},
        graph.pose(KeyframeId{from}).inverse() * graph.pose(KeyframeId{to}), information, kind));
  };
  for (uint64_t k = 1; k < CompressedWalk::kKeyframes; ++k) edge(k - 1, k, step, Kind::kOdometry);
  walk.drop(walk.factorsOfDropped(), std::nullopt);
  edge(1, 5, 4.0 * step, Kind::kBridge);

  const Divergence d = compareWithOriginal(*graph.snapshot()).divergence;
  EXPECT_EQ(d.dof, 18);
  // sigma^2 of keyframe 5: 1 + 1/4 for 5; of keyframe 6: 2 + 1/4 for 6
  EXPECT_NEAR(d.smallest->ratio, std::sqrt(1.25 / 5.0), 1e-4);
  EXPECT_EQ(d.smallest->node, NodeId(KeyframeId{5}));
  EXPECT_NEAR(d.largest->ratio, 1.0, 1e-6);
  // six directions with the ratio 16 of informations, however the others go on from there
  EXPECT_NEAR(d.full_to_compressed, 0.5 * 6.0 * (16.0 - 1.0 - std::log(16.0)), 1e-4);
  EXPECT_NEAR(d.compressed_to_full, 0.5 * 6.0 * (1.0 / 16.0 - 1.0 + std::log(16.0)), 1e-4);
}

TEST(Consistency, StandInsAreNotCountedTwice) {
  CompressedWalk walk;
  const FactorId loop_of_dropped = walk.addRelative(3, 6, Kind::kLoopClosure);
  const FactorId true_loop = walk.addRelative(1, 6, Kind::kLoopClosure);
  const std::size_t measured = walk.graph.factorCount();
  std::vector<FactorId> shelved = walk.factorsOfDropped();
  shelved.erase(std::find(shelved.begin(), shelved.end(), loop_of_dropped));
  walk.drop(shelved, KeyframeId{1});
  walk.graph.shelve(loop_of_dropped, std::nullopt);
  const FactorId transferred = walk.addRelative(1, 6, Kind::kBridge);
  const FactorId earlier_transferred = walk.addRelative(2, 6, Kind::kBridge);
  walk.graph.shelve(earlier_transferred, KeyframeId{1});

  const auto original = originalFactors(*walk.graph.snapshot());
  EXPECT_EQ(original.size(), measured);
  const auto has = [&](FactorId id) {
    return std::count(original.begin(), original.end(), walk.graph.factor(id).get()) == 1;
  };
  EXPECT_TRUE(has(loop_of_dropped));
  EXPECT_TRUE(has(true_loop));
  EXPECT_FALSE(has(transferred));
  EXPECT_FALSE(has(earlier_transferred));
}

TEST(Consistency, WithoutTheShelfThereIsNothingToCompareWith) {
  CompressedWalk walk;
  walk.condense();
  const GraphSnapshotConstPtr before = walk.graph.snapshot();
  for (const ShelvedFactor& shelved : before->shelved) {
    walk.graph.eraseFactor(shelved.id);
  }
  EXPECT_THROW(compareWithOriginal(*walk.graph.snapshot()), std::runtime_error);
  CompressedWalk bridged;
  bridged.addRelative(1, 5, Kind::kBridge);
  EXPECT_THROW(originalFactors(*bridged.graph.snapshot()), std::runtime_error);
}

TEST(Consistency, WallsThatOnlyDroppedKeyframesSawAreNamed) {
  CompressedWalk walk;
  walk.graph.restoreWall(WallId{7}, Plane{Eigen::Vector3d::UnitY(), 4.0}, {});
  walk.addSighting(3, 7);
  walk.drop(walk.factorsOfDropped(), KeyframeId{1});
  walk.addRelative(1, 5, Kind::kBridge);
  const CompressionReport report = compareWithOriginal(*walk.graph.snapshot());
  ASSERT_EQ(report.lost.size(), 1U);
  EXPECT_EQ(report.lost[0], NodeId(WallId{7}));
  EXPECT_EQ(report.divergence.dof, 27);
  EXPECT_EQ(report.divergence.undetermined_compressed, 0);
}

TEST(Consistency, AGraphWithoutKeyframesIsRefused) {
  EXPECT_THROW(compareWithOriginal(*LayeredGraph().snapshot()), std::runtime_error);
  EXPECT_THROW(posesAgainstTruth(*LayeredGraph().snapshot(), {}, 0.1), std::runtime_error);
}

/// Keyframes that are measured from the first one each, with errors drawn from their covariances.
class PoseConsistencyTest : public ::testing::Test {
 protected:
  static constexpr int kKeyframes = 2000;

  PoseConsistencyTest() {
    std::mt19937 generator(4);
    std::normal_distribution<double> normal;
    const Pose T_truth_map = random_.pose();
    for (int k = 0; k <= kKeyframes; ++k) {
      const Pose T_map_base = random_.pose();
      const double stamp_s = 100.0 + k;
      truth_.push_back({stamp_s, T_truth_map * T_map_base});
      KeyframeAttributes attributes;
      attributes.stamp_s = stamp_s;
      if (k == 0) {
        graph_.addKeyframe(T_map_base, attributes);
        continue;
      }
      const Matrix6 information = 1e4 * test::randomInformation<6>(&random_);
      const Tangent drawn = Tangent::NullaryExpr([&] { return normal(generator); });
      const Pose T_estimated = retract(T_map_base, information.llt().matrixU().solve(drawn));
      const KeyframeId id = graph_.addKeyframe(T_estimated, attributes);
      graph_.addFactor(std::make_shared<RelativePoseFactor>(
          KeyframeId{0}, id, graph_.pose(KeyframeId{0}).inverse() * T_estimated, information));
    }
  }

  test::RandomGeometry random_{6, 20.0};
  LayeredGraph graph_;
  Trajectory truth_;
};

TEST_F(PoseConsistencyTest, IsTheDegreesOfFreedomWhereCovariancesAreRight) {
  const PoseConsistency got = posesAgainstTruth(*graph_.snapshot(), truth_, 0.1);
  EXPECT_EQ(got.keyframes, 2000U);
  EXPECT_EQ(got.without_truth, 0U);
  EXPECT_EQ(got.pose.dof, 6);
  EXPECT_EQ(got.position.dof, 3);
  // chi2 of n degrees: variance 2 n, so three sigmas of the mean of 2000 are 3 sqrt(2 n / 2000)
  EXPECT_NEAR(got.pose.mean, 6.0, 0.23);
  EXPECT_NEAR(got.position.mean, 3.0, 0.17);
  EXPECT_NEAR(got.pose.median, 5.348, 0.25);
  EXPECT_NEAR(got.pose.p95, 12.592, 0.8);
  EXPECT_NEAR(got.position.p95, 7.815, 0.6);
}

TEST_F(PoseConsistencyTest, GrowsWithOverconfidence) {
  const GraphSnapshotConstPtr before = graph_.snapshot();
  for (const StoredFactor& stored : before->factors) {
    const auto& edge = dynamic_cast<const RelativePoseFactor&>(*stored.factor);
    graph_.replaceFactor(
        stored.id, std::make_shared<RelativePoseFactor>(edge.node(0), edge.node(1), edge.T_from_to,
                                                        4.0 * edge.information()));
  }
  EXPECT_NEAR(posesAgainstTruth(*graph_.snapshot(), truth_, 0.1).pose.mean, 24.0, 0.92);
}

TEST_F(PoseConsistencyTest, TruthIsInterpolatedWhereItIsDense) {
  // each pose is a half of the way between two others, and its own is not there
  Trajectory around;
  for (const StampedPose& pose : truth_) {
    for (const double side : {-1.0, 1.0}) {
      Tangent step = Tangent::Zero();
      step[5] = 0.1 * side;
      StampedPose other{pose.stamp_s + 0.04 * side, retract(pose.T_world_body, step)};
      other.T_world_body.translation() += side * Eigen::Vector3d(0.3, 0.1, 0.0);
      around.push_back(other);
    }
  }
  const PoseConsistency exact = posesAgainstTruth(*graph_.snapshot(), truth_, 0.1);
  const PoseConsistency got = posesAgainstTruth(*graph_.snapshot(), around, 0.1);
  EXPECT_NEAR(got.pose.mean, exact.pose.mean, 1e-3);
  EXPECT_NEAR(got.pose.p95, exact.pose.p95, 1e-3);

  around.erase(around.begin() + 20, around.begin() + 24);  // of two keyframes
  const PoseConsistency fewer = posesAgainstTruth(*graph_.snapshot(), around, 0.1);
  EXPECT_EQ(fewer.without_truth, 2U);
  EXPECT_EQ(fewer.keyframes, 1998U);
  EXPECT_THROW(posesAgainstTruth(*graph_.snapshot(), around, 0.05), std::runtime_error);
}

TEST_F(PoseConsistencyTest, DroppedKeyframesAreNotCounted) {
  KeyframeAttributes attributes = graph_.attributes(KeyframeId{5});
  attributes.marginalized = true;
  attributes.representative = KeyframeId{4};
  graph_.setAttributes(KeyframeId{5}, attributes);
  EXPECT_EQ(posesAgainstTruth(*graph_.snapshot(), truth_, 0.1).keyframes, 1999U);
}

}  // namespace
}  // namespace mrpt_sgraphs
