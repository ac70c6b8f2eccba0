// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "support/dense_problem.h"

namespace mrpt_sgraphs {
namespace {

using test::DenseProblem;
using test::Values;

const KeyframeId kKept{0};
const KeyframeId kBoundary{4};

class CondensedTest : public ::testing::TestWithParam<double> {
 protected:
  /// Over a pose and two planes, with its nodes at their linearization points.
  std::pair<CondensedFactor, Values> randomFactor(double eta) {
    const Pose T_map_kept = random_.pose();
    const Pose T_kept_other = random_.smallPose(8.0, 2.0);
    const Plane wall_kept = test::randomPlane(&random_, 8.0);
    const Plane floor_kept = test::randomPlane(&random_, 8.0);
    CondensedFactor::Quadratic quadratic;
    Eigen::MatrixXd root(12, 7);  // rank 7 of 12
    for (int k = 0; k < root.size(); ++k) root(k) = random_.number(1.0);
    quadratic.Lambda = root * root.transpose();
    quadratic.eta = eta * quadratic.Lambda * Eigen::VectorXd::Ones(12);
    quadratic.c = 3.0;
    return {
        CondensedFactor(
            kKept, {{kBoundary, T_kept_other}, {WallId{1}, wall_kept}, {FloorId{2}, floor_kept}},
            quadratic),
        {T_map_kept, T_map_kept * T_kept_other, T_map_kept * wall_kept, T_map_kept * floor_kept}};
  }

  Eigen::VectorXd disturbance(Eigen::Index rows) {
    Eigen::VectorXd delta(rows);
    for (double& d : delta) d = random_.number(0.3);
    return delta;
  }

  test::RandomGeometry random_{13, GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Extents, CondensedTest, ::testing::Values(1.0, 50.0, 500.0));

TEST_P(CondensedTest, HasItsMinimumWhereItWasLinearized) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto [factor, values] = randomFactor(0.0);
    const test::Linearized got = test::linearize(factor, values);
    EXPECT_NEAR(got.cost, 3.0, 1e-9);
    EXPECT_NEAR(got.g.norm(), 0.0, 1e-9);
  }
}

TEST_P(CondensedTest, DoesNotDependOnWhereTheMapOriginIs) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto [factor, at_linearization] = randomFactor(0.1);
    const Values values = test::retracted(at_linearization, disturbance(18));
    const Values moved = test::moved(random_.pose(), values);
    EXPECT_NEAR(factor.cost(test::views(moved).data()), factor.cost(test::views(values).data()),
                1e-8);
    EXPECT_GT(std::abs(factor.cost(test::views(values).data()) - 3.0), 1e-3);
  }
}

TEST_P(CondensedTest, GradientAndHessianMatchDifferencesOfTheCost) {
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const auto [factor, at_linearization] = randomFactor(0.1);
    test::expectGradientMatches(factor, test::retracted(at_linearization, disturbance(18)));

    const auto [flat, values] = randomFactor(0.0);
    const auto gradient = [&, &flat = flat](const Values& v) { return test::linearize(flat, v).g; };
    const Eigen::MatrixXd H = test::linearize(flat, values).H;
    const Eigen::MatrixXd numeric = test::centralDifferences(gradient, values, 18, 1e-5);
    EXPECT_NEAR((H - numeric).norm(), 0.0, 1e-6 * H.norm());
  }
}

TEST(Condensed, RefusesWhatDoesNotFit) {
  using Quadratic = CondensedFactor::Quadratic;
  const Quadratic three{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 0.0};
  EXPECT_NO_THROW(CondensedFactor(kKept, {{WallId{1}, Plane{}}}, three));
  EXPECT_THROW(CondensedFactor(kKept, {{kBoundary, Plane{}}}, three), std::invalid_argument);
  EXPECT_THROW(CondensedFactor(kKept, {{WallId{1}, Pose::Identity()}}, three),
               std::invalid_argument);
  EXPECT_THROW(CondensedFactor(kKept, {{kBoundary, Pose::Identity()}}, three),
               std::invalid_argument);
}

/// A walk 0, 1, 2, 3, 4 along three walls. Keyframes 1 to 3 are eliminated; 0 is kept, 4 is the
/// next room's, and other factors remain between them and the walls.
class CondensedWalkTest : public CondensedTest {
 protected:
  void SetUp() override {
    const std::vector<Plane> walls_local{
        {{1.0, 0.0, 0.0}, -3.0}, {{0.0, -1.0, 0.0}, -2.0}, {{0.0, 0.0, 1.0}, -0.5}};
    const Pose T_map_local = random_.pose();
    std::vector<Pose> truth{T_map_local};
    for (int k = 0; k < 4; ++k) truth.push_back(truth.back() * random_.smallPose(1.0, 0.5));
    for (std::size_t k = 0; k < truth.size(); ++k) full_.values[KeyframeId{k}] = truth[k];
    for (std::size_t w = 0; w < 3; ++w) full_.values[WallId{w}] = T_map_local * walls_local[w];

    for (std::size_t k = 0; k < 4; ++k) {
      eliminated_.push_back(odometry(KeyframeId{k}, KeyframeId{k + 1}));
    }
    for (std::size_t k = 1; k < 4; ++k) {
      for (std::size_t w = 0; w < 3; ++w) {
        eliminated_.push_back(observation(KeyframeId{k}, WallId{w}));
      }
    }
    remaining_ = {odometry(kKept, kBoundary), observation(kKept, WallId{0}),
                  observation(kBoundary, WallId{1}), observation(kBoundary, WallId{2}),
                  std::make_shared<PosePriorFactor>(kKept, truth[0], 100.0 * Matrix6::Identity())};
    full_.factors = eliminated_;
    full_.factors.insert(full_.factors.end(), remaining_.begin(), remaining_.end());
    full_.minimize();
  }

  FactorConstPtr odometry(KeyframeId from, KeyframeId to) {
    const Pose T_from_to = poseOf(from).inverse() * poseOf(to) * random_.smallPose(0.05, 0.02);
    return std::make_shared<RelativePoseFactor>(from, to, T_from_to,
                                                test::randomInformation<6>(&random_));
  }
  FactorConstPtr observation(KeyframeId keyframe, WallId wall) {
    const Plane seen_base =
        random_.smallPose(0.03, 0.02) * inverseTimes(poseOf(keyframe), planeOf(wall));
    return std::make_shared<PlaneObservationFactor>(keyframe, wall, seen_base,
                                                    test::randomInformation<3>(&random_));
  }
  const Pose& poseOf(KeyframeId id) const { return std::get<Pose>(full_.values.at(id)); }
  const Plane& planeOf(WallId id) const { return std::get<Plane>(full_.values.at(id)); }

  /// The eliminated factors and their nodes, in the kept keyframe's frame.
  DenseProblem inKeptFrame() const {
    DenseProblem local;
    const Pose T_kept_map = poseOf(kKept).inverse();
    for (const auto& [node, value] : full_.values) {
      local.values[node] = test::moved(T_kept_map, {value})[0];
    }
    local.factors = eliminated_;
    return local;
  }
  test::Linearized marginal(const DenseProblem& local) const {
    return test::schurComplement(local.linearize(),
                                 local.rowsOf({kKept, kBoundary, WallId{0}, WallId{1}, WallId{2}}),
                                 local.rowsOf({KeyframeId{1}, KeyframeId{2}, KeyframeId{3}}));
  }
  std::shared_ptr<CondensedFactor> condensed() const {
    const DenseProblem local = inKeptFrame();
    const test::Linearized onto = marginal(local);
    std::vector<CondensedFactor::Other> others;
    for (const NodeId node :
         {NodeId(kBoundary), NodeId(WallId{0}), NodeId(WallId{1}), NodeId(WallId{2})}) {
      others.push_back({node, local.values.at(node)});
    }
    return std::make_shared<CondensedFactor>(
        kKept, others,
        CondensedFactor::Quadratic{onto.H.bottomRightCorner(15, 15), -onto.g.tail(15), onto.cost});
  }

  DenseProblem full_;
  std::vector<FactorConstPtr> eliminated_;
  std::vector<FactorConstPtr> remaining_;
};
INSTANTIATE_TEST_SUITE_P(Extents, CondensedWalkTest, ::testing::Values(1.0, 50.0, 500.0));

// What is not stored, the rows of the kept keyframe, follows from the rest.
TEST_P(CondensedWalkTest, IsTheSchurComplementInTheKeptFrame) {
  const DenseProblem local = inKeptFrame();
  const test::Linearized expected = marginal(local);
  const auto factor = condensed();
  const test::Linearized got = test::linearize(*factor, local.valuesOf(*factor));
  EXPECT_NEAR((got.H - expected.H).norm(), 0.0, 1e-9 * expected.H.norm());
  EXPECT_NEAR((got.g - expected.g).norm(), 0.0, 1e-9 * expected.H.norm());
  EXPECT_GT(got.g.norm(), 1e-3);
  EXPECT_NEAR(got.cost, expected.cost, 1e-9);
}

TEST_P(CondensedWalkTest, HasTheMinimumOfTheFullProblem) {
  DenseProblem compressed;
  for (const auto& [node, value] : full_.values) {
    if (node.layer == Layer::kKeyframe && node != kKept && node != kBoundary) continue;
    compressed.values[node] =
        test::retracted(Values{value}, 0.1 * disturbance(tangentSize(node.layer)))[0];
  }
  compressed.factors = remaining_;
  compressed.factors.push_back(condensed());
  compressed.minimize();

  EXPECT_NEAR(compressed.linearize().cost, full_.linearize().cost, 1e-7);
  for (const auto& [node, value] : compressed.values) {
    const test::Value expected = full_.values.at(node);
    if (isPlane(node.layer)) {
      const PlaneTangent off = local(std::get<Plane>(expected), std::get<Plane>(value));
      EXPECT_NEAR(off.norm(), 0.0, 1e-8 * (1.0 + GetParam())) << nameOf(node);
    } else {
      const Tangent off = local(std::get<Pose>(expected), std::get<Pose>(value));
      EXPECT_NEAR(off.norm(), 0.0, 1e-8 * (1.0 + GetParam())) << nameOf(node);
    }
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
