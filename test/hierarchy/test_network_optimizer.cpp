// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "io/temporary_folder.h"
#include "mrpt_sgraphs/graph/mrpt_information.h"
#include "mrpt_sgraphs/hierarchy/network_optimizer.h"
#include "support/mrpt_networks.h"

namespace mrpt_sgraphs {
namespace {

using mrpt::graphs::TNodeID;

bool isSame(const mrpt::poses::CPose3D& a, const mrpt::poses::CPose3D& b) {
  return fromMrpt(a).matrix() == fromMrpt(b).matrix();
}

/// Measured without error, in the ways of a walk; the nodes lie where noise has led.
MrptNetwork walkMeasuredExactly(const MrptNetwork& truth) {
  MrptNetwork network = truth;
  for (auto& [ends, edge] : network.edges) {
    edge.mean = truth.nodes.at(ends.second) - truth.nodes.at(ends.first);
  }
  test::RandomGeometry random(3);
  for (auto& [id, pose] : network.nodes) {
    if (id == network.root) continue;
    static_cast<mrpt::poses::CPose3D&>(pose) = toMrpt(fromMrpt(pose) * random.smallPose(0.3, 0.1));
  }
  return network;
}

TEST(NetworkOptimizer, FindsTheTruthAndLeavesTheRootWhereItIs) {
  MrptNetwork truth = test::circlingWalk(1);
  truth.root = 7;
  MrptNetwork network = walkMeasuredExactly(truth);
  const OptimizerReport report = optimizeNetwork({}, &network);
  EXPECT_TRUE(report.converged) << report.problem;
  EXPECT_TRUE(report.gauge.empty());
  EXPECT_LT(report.cost_after, 1e-6);
  for (const auto& [id, pose] : truth.nodes) {
    EXPECT_LT((fromMrpt(network.nodes.at(id)).matrix() - fromMrpt(pose).matrix()).norm(), 1e-5);
  }
  EXPECT_TRUE(isSame(network.nodes.at(7), truth.nodes.at(7)));
}

TEST(NetworkOptimizer, MovesWhatItIsToldToAndNothingElse) {
  const MrptNetwork start = test::circlingWalk(2);
  MrptNetwork network = start;
  const std::set<TNodeID> free{20, 21, 22, 40};
  const OptimizerReport report = optimizeNetwork({}, &network, &free);
  EXPECT_EQ(report.free_tangents, 24);
  EXPECT_LT(report.cost_after, report.cost_before);
  for (const auto& [id, pose] : start.nodes) {
    EXPECT_EQ(isSame(network.nodes.at(id), pose), free.count(id) == 0) << id;
  }
  EXPECT_EQ(network.edges.size(), start.edges.size());
}

TEST(NetworkOptimizer, CostIsMrptsChi2WhereResidualsAreSmall) {
  // By MRPT's own propagation of the informations to the map's frame, for rotations of any size. It
  // goes through quaternions and loses the sign of what couples translation and rotation where it
  // turns q into -q, so there is no such coupling here.
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    MrptNetwork network = test::oddNetwork(seed, 3.0);
    test::RandomGeometry random(seed + 100);
    for (auto& [ends, edge] : network.edges) {
      const mrpt::poses::CPose3D exact =
          network.nodes.at(ends.second) - network.nodes.at(ends.first);
      edge.mean = toMrpt(fromMrpt(exact) * random.smallPose(1e-6, 1e-6));
      Matrix6 information = edge.cov_inv.asEigen();
      information.topRightCorner<3, 3>().setZero();
      information.bottomLeftCorner<3, 3>().setZero();
      edge.cov_inv = mrpt::math::CMatrixDouble66(information);
    }
    const double chi2 = network.chi2();
    EXPECT_NEAR(networkCost(network), chi2, 1e-3 * chi2);
    EXPECT_GT(std::abs(networkCost(network, MrptInformation::kPermuted) - chi2), 0.01 * chi2);
    EXPECT_GT(std::abs(networkCost(network, MrptInformation::kTangent) - chi2), 0.01 * chi2);
  }
}

TEST(NetworkOptimizer, MeaningsDifferAsTheySay) {
  MrptNetwork network = test::circlingWalk(4);
  const double tangent = networkCost(network, MrptInformation::kTangent);
  const double permuted = networkCost(network, MrptInformation::kPermuted);
  for (auto& [ends, edge] : network.edges) {
    edge.cov_inv = mrpt::math::CMatrixDouble66(permutedInformation(edge.cov_inv.asEigen()));
  }
  EXPECT_NEAR(networkCost(network, MrptInformation::kPermuted), tangent, 1e-9 * tangent);
  EXPECT_NEAR(networkCost(network, MrptInformation::kTangent), permuted, 1e-9 * permuted);
}

TEST(NetworkOptimizer, EdgesMayStoreInversePoses) {
  MrptNetwork network = test::circlingWalk(5);
  MrptNetwork inverse = network;
  inverse.edges.clear();
  inverse.edges_store_inverse_poses = true;
  for (const auto& [ends, edge] : network.edges) {
    inverse.insertEdge(ends.second, ends.first, edge);
  }
  EXPECT_NEAR(networkCost(inverse), networkCost(network), 1e-9 * networkCost(network));
  optimizeNetwork({}, &network);
  optimizeNetwork({}, &inverse);
  EXPECT_NEAR(networkCost(inverse), networkCost(network), 1e-6 * networkCost(network));
}

TEST(NetworkOptimizer, NothingToDoIsNoError) {
  MrptNetwork empty;
  EXPECT_EQ(optimizeNetwork({}, &empty).factors, 0);
  EXPECT_EQ(networkCost(empty), 0.0);

  MrptNetwork one;
  one.nodes[0] = mrpt::poses::CPose3D();
  EXPECT_EQ(optimizeNetwork({}, &one).factors, 0);

  MrptNetwork network = test::circlingWalk(6);
  const std::set<TNodeID> none;
  EXPECT_EQ(optimizeNetwork({}, &network, &none).free_tangents, 0);
}

TEST(NetworkOptimizer, NamesAPartThatNothingHolds) {
  MrptNetwork network = test::circlingWalk(7, 20);
  network.nodes[100] = mrpt::poses::CPose3D();
  network.nodes[101] = mrpt::poses::CPose3D();
  MrptNetwork::edge_t edge;
  edge.mean = mrpt::poses::CPose3D(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  edge.cov_inv.setIdentity();
  network.insertEdge(100, 101, edge);
  const OptimizerReport report = optimizeNetwork({}, &network);
  ASSERT_EQ(report.gauge.size(), 1U);
  EXPECT_EQ(report.gauge[0].dimensions, 6);
  EXPECT_NEAR(network.nodes.at(100).distanceTo(network.nodes.at(101)), 1.0, 1e-6);
}

TEST(NetworkOptimizer, NamesWhatItCannotUse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    void (*spoil)(MrptNetwork*, double nan);
    std::string reason;
  } kCases[] = {
      {[](MrptNetwork* n, double x) { n->nodes.at(3).y(x); }, "node 3: its pose is not finite"},
      {[](MrptNetwork* n, double x) {
         n->edges.find({4, 5})->second.cov_inv(0, 0) = x;
       },
       "edge 4 -> 5: its information is not finite"},
      {[](MrptNetwork* n, double) {
         n->edges.find({4, 5})->second.cov_inv(5, 5) = -1.0;
       },
       "edge 4 -> 5: its information is not positive semidefinite"},
      {[](MrptNetwork* n, double) { n->nodes.erase(6); }, "there is no node 6"},
      {[](MrptNetwork* n, double) { n->nodes.clear(); }, "edges and no nodes"},
  };
  for (const auto& [spoil, reason] : kCases) {
    MrptNetwork network = test::circlingWalk(8, 20);
    spoil(&network, nan);
    const std::string error =
        test::messageOf<std::invalid_argument>([&] { optimizeNetwork({}, &network); });
    EXPECT_NE(error.find(reason), std::string::npos) << error;
  }
  MrptNetwork network = test::circlingWalk(8, 20);
  const std::set<TNodeID> missing{77};
  EXPECT_THROW(optimizeNetwork({}, &network, &missing), std::invalid_argument);
}

TEST(NetworkOptimizer, ASemidefiniteInformationIsFine) {
  MrptNetwork network = test::circlingWalk(9);
  auto& information = network.edges.find({0, 12})->second.cov_inv;
  information.setZero();
  information(2, 2) = 1e4;  // height alone was measured
  const OptimizerReport report = optimizeNetwork({}, &network);
  EXPECT_TRUE(report.converged) << report.problem;
}

}  // namespace
}  // namespace mrpt_sgraphs
