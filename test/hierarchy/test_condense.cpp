// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/hierarchy/condense.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "support/dense_problem.h"
#include "support/storey_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::StoreyLab;

/// The first room's visit of nine keyframes: its first is kept, the others are dropped.
class CondenseTest : public ::testing::Test {
 protected:
  CondenseTest() { fill(&lab_); }

  static void fill(StoreyLab* lab) {
    lab->tour();
    lab->optimize();
  }

  static std::vector<KeyframeId> dropped(const StoreyLab& lab) {
    const auto& all = lab.keyframes[StoreyLab::kFirst];
    return {all.begin() + 1, all.end()};
  }
  static KeyframeId kept(const StoreyLab& lab) { return lab.keyframes[StoreyLab::kFirst][0]; }

  static std::vector<FactorConstPtr> factorsOf(const std::vector<KeyframeId>& keyframes,
                                               const LayeredGraph& graph) {
    std::set<FactorId> ids;
    for (const KeyframeId id : keyframes) {
      for (const FactorLink& link : graph.sightingsOf(id)) ids.insert(link.id);
      for (const FactorLink& link : graph.otherFactorsOf(id)) ids.insert(link.id);
    }
    std::vector<FactorConstPtr> factors;
    for (const FactorId id : ids) factors.push_back(graph.factor(id));
    return factors;
  }

  static void expectNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double relative) {
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    EXPECT_LE((a - b).norm(), relative * b.norm());
  }

  static void expectSame(const CondensedFactor& a, const CondensedFactor& b, double relative) {
    expectNear(a.quadratic().Lambda, b.quadratic().Lambda, relative);
    // the gradient is a small difference of large terms
    EXPECT_LE((a.quadratic().eta - b.quadratic().eta).norm(),
              relative * b.quadratic().Lambda.norm());
    EXPECT_NEAR(a.quadratic().c, b.quadratic().c, relative * (1.0 + b.quadratic().c));
    ASSERT_EQ(a.others().size(), b.others().size());
    for (std::size_t k = 0; k < a.others().size(); ++k) {
      EXPECT_EQ(a.others()[k].node, b.others()[k].node);
    }
  }

  StoreyLab lab_;
};

TEST_F(CondenseTest, IsTheMarginalOfTheFullProblem) {
  const auto factors = factorsOf(dropped(lab_), lab_.graph);
  const auto condensed = condense(factors, kept(lab_), dropped(lab_), lab_.graph);
  ASSERT_NE(condensed, nullptr);
  EXPECT_STREQ(condensed->type(), "condensed");

  test::DenseProblem dense;  // in the kept keyframe's frame, as it is linearized
  const Pose T_kept_map = lab_.graph.pose(kept(lab_)).inverse();
  std::vector<NodeId> gone;
  std::vector<NodeId> remaining;
  for (const KeyframeId id : dropped(lab_)) gone.push_back(id);
  for (int k = 0; k < condensed->nodeCount(); ++k) remaining.push_back(condensed->node(k));
  for (const auto* nodes : {&gone, &remaining}) {
    for (const NodeId node : *nodes) {
      const NodeHandle handle = lab_.graph.handle(node);
      if (isPlane(node.layer)) {
        dense.values[node] = T_kept_map * lab_.graph.plane(handle);
      } else {
        dense.values[node] = T_kept_map * lab_.graph.pose(handle);
      }
    }
  }
  dense.factors = factors;
  const test::Linearized expected =
      test::schurComplement(dense.linearize(), dense.rowsOf(remaining), dense.rowsOf(gone));
  const test::Linearized got = test::linearize(*condensed, dense.valuesOf(*condensed));
  expectNear(got.H, expected.H, 1e-9);
  EXPECT_LE((got.g - expected.g).norm(), 1e-9 * expected.H.norm());
  EXPECT_NEAR(got.cost, expected.cost, 1e-9 * expected.cost);
}

TEST_F(CondenseTest, SaysNothingOnWhereEverythingIs) {
  const auto condensed =
      condense(factorsOf(dropped(lab_), lab_.graph), kept(lab_), dropped(lab_), lab_.graph);
  std::vector<test::Value> values;
  for (int k = 0; k < condensed->nodeCount(); ++k) {
    const NodeHandle handle = lab_.graph.handle(condensed->node(k));
    if (isPlane(handle.layer)) {
      values.emplace_back(lab_.graph.plane(handle));
    } else {
      values.emplace_back(lab_.graph.pose(handle));
    }
  }
  const test::Linearized whole = test::linearize(*condensed, values);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(whole.H);
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();
  const double nothing = 1e-9 * eigenvalues.maxCoeff();
  EXPECT_LE((eigenvalues.array() > nothing).count(), whole.H.rows() - 6);
  EXPECT_GE(eigenvalues.minCoeff(), -nothing);
  // and moved anywhere it costs the same
  test::RandomGeometry random(3, 200.0);
  for (int k = 0; k < 5; ++k) {
    const test::Values moved = test::moved(random.pose(), values);
    EXPECT_NEAR(condensed->cost(test::views(moved).data()), whole.cost, 1e-6 * whole.cost);
  }
}

TEST_F(CondenseTest, TwiceIsAsOnce) {
  const std::vector<KeyframeId> all = dropped(lab_);
  const std::vector<KeyframeId> first(all.begin(), all.begin() + 3);
  const std::vector<KeyframeId> second(all.begin() + 3, all.end());
  const auto factors = factorsOf(all, lab_.graph);
  const auto at_once = condense(factors, kept(lab_), all, lab_.graph);
  const auto of_first = factorsOf(first, lab_.graph);
  std::vector<FactorConstPtr> then{condense(of_first, kept(lab_), first, lab_.graph)};
  for (const FactorConstPtr& factor : factors) {
    if (std::find(of_first.begin(), of_first.end(), factor) == of_first.end()) {
      then.push_back(factor);
    }
  }
  const auto twice = condense(then, kept(lab_), second, lab_.graph);
  expectSame(*twice, *at_once, 1e-9);
  // nothing to drop: what is condensed stays what it is
  expectSame(*condense({at_once}, kept(lab_), {}, lab_.graph), *at_once, 1e-9);
  expectSame(*condenseInSteps(factors, kept(lab_), all, lab_.graph), *at_once, 1e-9);
}

TEST_F(CondenseTest, InStepsIsAsAtOnce) {
  std::vector<KeyframeId> most;  // more than are taken at a time
  for (std::size_t k = 1; k + 1 < lab_.truth.size(); ++k) most.push_back(KeyframeId{k});
  const auto factors = factorsOf(most, lab_.graph);
  const KeyframeId first{0};
  expectSame(*condenseInSteps(factors, first, most, lab_.graph),
             *condense(factors, first, most, lab_.graph), 1e-8);
}

TEST_F(CondenseTest, DoesNotDependOnWhereTheMapIs) {
  test::RandomGeometry random(11, 100.0);
  const auto here =
      condense(factorsOf(dropped(lab_), lab_.graph), kept(lab_), dropped(lab_), lab_.graph);
  for (int k = 0; k < 3; ++k) {
    const Pose motion = random.pose();
    StoreyLab other;
    fill(&other);
    for (std::size_t id = 0; id < other.truth.size(); ++id) {
      const KeyframeId keyframe{id};
      other.graph.setPose(keyframe, orthonormalized(motion * lab_.graph.pose(keyframe)));
    }
    for (const auto& walls : other.walls) {
      for (const WallId wall : walls) {
        other.graph.setPlane(wall, motion * lab_.graph.plane(wall));
      }
    }
    other.graph.setPlane(other.floor, motion * lab_.graph.plane(lab_.floor));
    const auto there =
        condense(factorsOf(dropped(other), other.graph), kept(other), dropped(other), other.graph);
    expectSame(*there, *here, 1e-8);
  }
}

TEST_F(CondenseTest, IsNothingWhereAKeyframeHangsOnNothing) {
  KeyframeAttributes attributes;
  attributes.stamp_s = 1e3;
  const KeyframeId lost = lab_.graph.addKeyframe(Pose::Identity(), attributes);
  lab_.graph.addFactor(std::make_shared<PlaneObservationFactor>(
      lost, lab_.walls[StoreyLab::kFirst][0], Plane{}, Eigen::Matrix3d::Identity()));
  EXPECT_EQ(condense(factorsOf({lost}, lab_.graph), kept(lab_), {lost}, lab_.graph), nullptr);
}

TEST_F(CondenseTest, KnowsHowFarOneComesByTheWayAlone) {
  const auto condensed =
      condense(factorsOf(dropped(lab_), lab_.graph), kept(lab_), dropped(lab_), lab_.graph);
  const KeyframeId outside{dropped(lab_).back().value + 1};
  int ways = 0;
  for (const CondensedFactor::Other& other : condensed->others()) {
    EXPECT_EQ(other.way_covariance.has_value(), other.node.layer == Layer::kKeyframe);
    if (other.node != NodeId(outside)) continue;
    ++ways;
    // nine steps of 2 cm and 5 mrad, turns on levers of a few metres
    EXPECT_NEAR(std::sqrt(other.way_covariance->bottomRightCorner<3, 3>().trace() / 3.0), 0.015,
                0.001);
    const double sigma_m = std::sqrt(other.way_covariance->topLeftCorner<3, 3>().trace() / 3.0);
    EXPECT_GT(sigma_m, 0.06);
    EXPECT_LT(sigma_m, 0.12);
  }
  EXPECT_EQ(ways, 1);
}

TEST_F(CondenseTest, WhatStaysCanBeWorkedOutBefore) {
  const auto condensed =
      condense(factorsOf(dropped(lab_), lab_.graph), kept(lab_), dropped(lab_), lab_.graph);
  test::Values values;
  std::vector<bool> is_fixed;
  test::RandomGeometry random(5);
  for (int k = 0; k < condensed->nodeCount(); ++k) {
    const NodeHandle handle = lab_.graph.handle(condensed->node(k));
    if (isPlane(handle.layer)) {
      values.emplace_back(
          retract(lab_.graph.plane(handle), PlaneTangent(random.vector(0.02))));
    } else {
      values.emplace_back(lab_.graph.pose(handle) * random.smallPose(0.05, 0.02));
    }
    is_fixed.push_back(k % 2 == 0);
  }
  const auto views = test::views(values);
  const CondensedFactor less = conditioned(*condensed, views.data(), is_fixed);
  std::vector<VariableView> moving{views[0]};
  Eigen::MatrixXd H(condensed->tangentRows(), condensed->tangentRows());
  Eigen::VectorXd g(condensed->tangentRows());
  const double cost = condensed->linearize(views.data(), H.data(), g.data());
  std::vector<Eigen::Index> rows;
  Eigen::Index row = 0;
  for (int k = 0; k < condensed->nodeCount(); ++k) {
    const int size = tangentSize(condensed->node(k).layer);
    if (!is_fixed[static_cast<std::size_t>(k)]) {
      moving.push_back(views[static_cast<std::size_t>(k)]);
      for (int i = 0; i < size; ++i) rows.push_back(row + i);
    }
    row += size;
  }
  Eigen::MatrixXd H_less(less.tangentRows(), less.tangentRows());
  Eigen::VectorXd g_less(less.tangentRows());
  EXPECT_NEAR(less.linearize(moving.data(), H_less.data(), g_less.data()), cost, 1e-9 * cost);
  ASSERT_EQ(static_cast<Eigen::Index>(rows.size()) + 6, less.tangentRows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i) + 6;
    EXPECT_NEAR(g_less(at), g(rows[i]), 1e-8 * g.norm());
    for (std::size_t j = 0; j <= i; ++j) {
      EXPECT_NEAR(H_less(at, static_cast<Eigen::Index>(j) + 6), H(rows[i], rows[j]),
                  1e-9 * H.norm());
    }
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
