// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// All factors of a graph, whatever becomes of them in it.
class FullCost {
 public:
  explicit FullCost(const LayeredGraph& graph) {
    for (uint32_t slot = 0; slot < graph.factorCount(); ++slot) {
      factors_.push_back(graph.factorAt(slot).factor);
    }
  }

  double of(const LayeredGraph& graph) const {
    double cost = 0.0;
    for (const FactorConstPtr& factor : factors_) {
      const auto count = static_cast<std::size_t>(factor->nodeCount());
      poses_.resize(std::max(poses_.size(), count));
      planes_.resize(std::max(planes_.size(), count));
      views_.resize(count);
      for (std::size_t k = 0; k < count; ++k) {
        const NodeHandle node = graph.handle(factor->node(static_cast<int>(k)));
        if (isPlane(node.layer)) {
          planes_[k] = graph.plane(node);
          views_[k] = VariableView(planes_[k]);
        } else {
          poses_[k] = graph.pose(node);
          views_[k] = VariableView(poses_[k]);
        }
      }
      cost += factor->cost(views_.data());
    }
    return cost;
  }

 private:
  std::vector<FactorConstPtr> factors_;
  mutable std::vector<Pose> poses_;
  mutable std::vector<Plane> planes_;
  mutable std::vector<VariableView> views_;
};

/// Where the nodes are.
class Values {
 public:
  explicit Values(const LayeredGraph& graph) {
    first_[static_cast<std::size_t>(Layer::kRoom)] = graph.size(Layer::kKeyframe);
    first_[static_cast<std::size_t>(Layer::kFloor)] = graph.size(Layer::kWall);
    forAll(graph, [&](NodeHandle node) {
      if (isPlane(node.layer)) {
        planes_.push_back(graph.plane(node));
      } else {
        poses_.push_back(graph.pose(node));
      }
    });
  }

  void writeTo(LayeredGraph* graph, NodeHandle node) const {
    const std::size_t place = first_[static_cast<std::size_t>(node.layer)] + node.slot;
    if (isPlane(node.layer)) {
      graph->setPlane(node, planes_[place]);
    } else {
      graph->setPose(node, poses_[place]);
    }
  }

 private:
  template <typename Visit>
  static void forAll(const LayeredGraph& graph, const Visit& visit) {
    for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
      for (uint32_t slot = 0; slot < graph.size(layer); ++slot) visit({layer, slot});
    }
  }

  std::array<std::size_t, 4> first_{};  ///< Of each layer, in one of these two.
  std::vector<Pose> poses_;
  std::vector<Plane> planes_;
};

}  // namespace mrpt_sgraphs
