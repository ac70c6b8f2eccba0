// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "graph_support.h"
#include "mrpt_sgraphs/graph/mrpt_information.h"

namespace mrpt_sgraphs {
namespace {

/// A graph that random operations are done to, and a simple model beside it.
class GraphOperations : public ::testing::TestWithParam<unsigned> {
 protected:
  void step() {
    switch (pick(keyframes_.size() < 20 || walls_.size() < 20 ? 2 : 12)) {
      case 0:
        addKeyframe();
        break;
      case 1:
        walls_.push_back(graph_.addWall(test::randomPlane(&random_), {}));
        break;
      case 2:
        erase(keyframes_.begin() + static_cast<std::ptrdiff_t>(pick(keyframes_.size())));
        break;
      case 3:
        eraseWall(pick(walls_.size()));
        break;
      case 4:
      case 5:
        eraseFactor();
        break;
      case 6:
        move();
        break;
      case 7:
      case 8:
        addSight();
        break;
      default:
        addEdge();
    }
  }

  void expectSame() const {
    ASSERT_EQ(graph_.factorCount(), factors_.size());
    expectSameAdjacency();
    expectSameNetwork();
  }

 private:
  std::size_t pick(std::size_t count) {
    return static_cast<std::size_t>(0.5 * (random_.number(1.0) + 1.0) *
                                    static_cast<double>(count)) %
           count;
  }

  void addKeyframe() {
    const Pose T_map_base = random_.pose();
    const KeyframeId id = graph_.addKeyframe(T_map_base, {});
    keyframes_.push_back(id);
    poses_[id] = T_map_base;
  }
  void erase(std::vector<KeyframeId>::iterator keyframe) {
    graph_.eraseNode(*keyframe);
    forgetFactorsOf(*keyframe);
    poses_.erase(*keyframe);
    keyframes_.erase(keyframe);
  }
  void eraseWall(std::size_t index) {
    graph_.eraseNode(walls_[index]);
    forgetFactorsOf(walls_[index]);
    walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(index));
  }
  void forgetFactorsOf(NodeId node) {
    for (auto it = factors_.begin(); it != factors_.end();) {
      const bool touches = it->second->node(0) == node || it->second->node(1) == node;
      it = touches ? factors_.erase(it) : std::next(it);
    }
  }
  void eraseFactor() {
    if (factors_.empty()) return;
    const auto it = std::next(factors_.begin(), static_cast<std::ptrdiff_t>(pick(factors_.size())));
    graph_.eraseFactor(it->first);
    factors_.erase(it);
  }
  void move() {
    const KeyframeId id = keyframes_[pick(keyframes_.size())];
    poses_[id] = random_.pose();
    graph_.setPose(id, poses_[id]);
  }
  void addSight() {
    const auto factor = test::sight(keyframes_[pick(keyframes_.size())],
                                    walls_[pick(walls_.size())], test::randomPlane(&random_));
    factors_[graph_.addFactor(factor)] = factor;
  }
  void addEdge() {
    const KeyframeId from = keyframes_[pick(keyframes_.size())];
    const KeyframeId to = keyframes_[pick(keyframes_.size())];
    if (from == to) return;
    const auto factor = test::odometry(from, to, random_.pose(), test::randomInformation(&random_));
    factors_[graph_.addFactor(factor)] = factor;  // there may be several between the two
  }

  void expectSameAdjacency() const {
    std::vector<NodeId> nodes(keyframes_.begin(), keyframes_.end());
    nodes.insert(nodes.end(), walls_.begin(), walls_.end());
    for (const NodeId node : nodes) {
      std::set<FactorId> expected;
      for (const auto& [id, factor] : factors_) {
        if (factor->node(0) == node || factor->node(1) == node) expected.insert(id);
      }
      std::set<FactorId> linked;
      std::vector<FactorLink> links = graph_.sightingsOf(node);
      for (const FactorLink& link : links) {
        ASSERT_EQ(factors_.at(link.id)->node(1).layer, Layer::kWall);
      }
      for (const FactorLink& link : graph_.otherFactorsOf(node)) {
        ASSERT_EQ(factors_.at(link.id)->node(1).layer, Layer::kKeyframe);
        links.push_back(link);
      }
      for (const FactorLink& link : links) {
        linked.insert(link.id);
        // by handles one comes to the same
        ASSERT_EQ(graph_.factorAt(link.slot).id, link.id);
        ASSERT_EQ(graph_.factorAt(link.slot).factor, factors_.at(link.id));
        ASSERT_EQ(graph_.factor(link.id), factors_.at(link.id));
        const FactorEnd& end = graph_.topology().ends(link.slot)[link.end];
        ASSERT_EQ(graph_.nodeAt(end.node), node);
        ASSERT_EQ(end.node, graph_.handle(node));
        ASSERT_EQ(factors_.at(link.id)->node(static_cast<int>(link.end)), node);
      }
      ASSERT_EQ(linked, expected) << nameOf(node);
      ASSERT_EQ(linked.size(), graph_.factorCountOf(node)) << "none is there twice";
    }
  }

  void expectSameNetwork() const {
    const LayeredGraph::Network& network = graph_.network();
    ASSERT_EQ(network.nodes.size(), poses_.size());
    for (const auto& [id, T_map_base] : poses_) {
      const auto& node = network.nodes.at(id.value);
      ASSERT_EQ(Eigen::Matrix3d(node.getRotationMatrix().asEigen()), T_map_base.linear());
      ASSERT_EQ(node.x(), T_map_base.translation().x());
      ASSERT_EQ(graph_.pose(id).matrix(), T_map_base.matrix());
    }
    if (!keyframes_.empty()) {
      ASSERT_EQ(network.root, keyframes_.front().value);
    }

    std::multimap<std::pair<uint64_t, uint64_t>, const RelativePoseFactor*> edges;
    for (const auto& [id, factor] : factors_) {
      if (const auto* edge = keyframeEdge(*factor)) {
        edges.insert({{edge->node(0).value, edge->node(1).value}, edge});
      }
    }
    ASSERT_EQ(network.edges.size(), edges.size());
    auto expected = edges.begin();
    for (const auto& [ends, edge] : network.edges) {
      ASSERT_EQ(ends, expected->first);
      const RelativePoseFactor& factor = *expected->second;
      ASSERT_EQ(edge.mean.y(), factor.T_from_to.translation().y());
      ASSERT_EQ(Eigen::Matrix3d(edge.mean.getRotationMatrix().asEigen()),
                factor.T_from_to.linear());
      ASSERT_EQ(Matrix6(edge.cov_inv.asEigen()),
                toYawPitchRollInformation(factor.T_from_to, factor.information()));
      ++expected;
    }
  }

  test::RandomGeometry random_{GetParam(), 50.0};
  LayeredGraph graph_;
  std::vector<KeyframeId> keyframes_;
  std::vector<WallId> walls_;
  std::map<KeyframeId, Pose> poses_;
  std::map<FactorId, FactorConstPtr> factors_;
};
INSTANTIATE_TEST_SUITE_P(Seeds, GraphOperations, ::testing::Range(0U, 8U));

TEST_P(GraphOperations, LeaveWhatTheModelHas) {
  for (int k = 0; k < 600; ++k) {
    step();
    expectSame();
    ASSERT_FALSE(HasFatalFailure()) << "after operation " << k;
  }
}

TEST(KeyframeNetwork, HoldsInformationInTheOrderOfMrpt) {
  Matrix6 information = Matrix6::Zero();
  information.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // about x, y, z: roll, pitch, yaw
  Tangent expected;
  expected << 1.0, 2.0, 3.0, 6.0, 5.0, 4.0;
  EXPECT_EQ(Tangent(toYawPitchRollInformation(Pose::Identity(), information).diagonal()), expected);
}

}  // namespace
}  // namespace mrpt_sgraphs
