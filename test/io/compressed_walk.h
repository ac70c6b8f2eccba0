// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/graph/layered_graph.h"
#include "support/dense_problem.h"

namespace mrpt_sgraphs::test {

/// A walk of keyframes 0 to 6 along walls 0 to 2, measured with noise; values are the true ones, so
/// not where the cost is least. Keyframes 2, 3 and 4 are those to drop, 1 is kept for them.
class CompressedWalk {
 public:
  static constexpr uint64_t kKeyframes = 7;

  explicit CompressedWalk(bool with_walls = true) {
    const std::vector<Plane> walls{
        {{1.0, 0.0, 0.0}, -3.0}, {{0.0, -1.0, 0.0}, -2.0}, {{0.0, 0.0, 1.0}, -0.5}};
    Pose T_map_base = random_.pose();
    for (uint64_t k = 0; k < kKeyframes; ++k) {
      KeyframeAttributes attributes;
      attributes.stamp_s = static_cast<double>(k);
      graph.restoreKeyframe(KeyframeId{k}, T_map_base, attributes);
      T_map_base = T_map_base * random_.smallPose(1.0, 0.5);
    }
    for (uint64_t k = 1; k < kKeyframes; ++k) addRelative(k - 1, k);
    for (uint64_t w = 0; with_walls && w < walls.size(); ++w) {
      graph.restoreWall(WallId{w}, walls[w], {});
      for (uint64_t k = 0; k < kKeyframes; ++k) addSighting(k, w);
    }
  }

  FactorId addRelative(uint64_t from, uint64_t to,
                       RelativePoseFactor::Kind kind = RelativePoseFactor::Kind::kOdometry) {
    const Pose T_from_to = graph.pose(KeyframeId{from}).inverse() * graph.pose(KeyframeId{to}) *
                           random_.smallPose(0.03, 0.01);
    return graph.addFactor(std::make_shared<RelativePoseFactor>(
        KeyframeId{from}, KeyframeId{to}, T_from_to, 100.0 * randomInformation<6>(&random_), kind));
  }

  FactorId addSighting(uint64_t keyframe, uint64_t wall) {
    const Plane seen_base =
        random_.smallPose(0.01, 0.01) *
        inverseTimes(graph.pose(KeyframeId{keyframe}), graph.plane(WallId{wall}));
    return graph.addFactor(std::make_shared<PlaneObservationFactor>(
        KeyframeId{keyframe}, WallId{wall}, seen_base, 100.0 * randomInformation<3>(&random_)));
  }

  /// The factors that touch a keyframe that is to drop.
  std::vector<FactorId> factorsOfDropped() const {
    std::vector<FactorId> ids;
    const GraphSnapshotConstPtr snapshot = graph.snapshot();
    for (const StoredFactor& stored : snapshot->factors) {
      for (int k = 0; k < stored.factor->nodeCount(); ++k) {
        const NodeId node = stored.factor->node(k);
        if (node.layer != Layer::kKeyframe || node.value < 2 || node.value > 4) continue;
        ids.push_back(stored.id);
        break;
      }
    }
    return ids;
  }

  void drop(const std::vector<FactorId>& shelved, std::optional<KeyframeId> kept) {
    for (const FactorId id : shelved) graph.shelve(id, kept);
    for (const uint64_t k : {2U, 3U, 4U}) {
      KeyframeAttributes attributes = graph.attributes(KeyframeId{k});
      attributes.marginalized = true;
      attributes.representative = KeyframeId{1};
      graph.setAttributes(KeyframeId{k}, attributes);
    }
  }

  /// The factors of those to drop where the kept keyframe is at the origin.
  DenseProblem inKeptFrame() const {
    DenseProblem local;
    const Pose T_kept_map = graph.pose(KeyframeId{1}).inverse();
    for (const FactorId id : factorsOfDropped()) {
      local.factors.push_back(graph.factor(id));
      for (int k = 0; k < local.factors.back()->nodeCount(); ++k) {
        const NodeId node = local.factors.back()->node(k);
        const NodeHandle handle = graph.handle(node);
        local.values[node] = isPlane(node.layer) ? Value(T_kept_map * graph.plane(handle))
                                                 : Value(T_kept_map * graph.pose(handle));
      }
    }
    return local;
  }

  /// Exactly, by a dense Schur complement.
  void condense(const std::optional<Matrix6>& way_covariance = std::nullopt) {
    const NodeId kept = KeyframeId{1};
    const DenseProblem local = inKeptFrame();
    std::vector<NodeId> dropped{KeyframeId{2}, KeyframeId{3}, KeyframeId{4}};
    std::vector<NodeId> remaining{kept};
    std::vector<CondensedFactor::Other> others;
    for (const auto& [node, value] : local.values) {
      if (node == kept || std::count(dropped.begin(), dropped.end(), node) != 0) continue;
      remaining.push_back(node);
      others.push_back({node, value});
      if (node.layer == Layer::kKeyframe) others.back().way_covariance = way_covariance;
    }
    const Linearized onto =
        schurComplement(local.linearize(), local.rowsOf(remaining), local.rowsOf(dropped));
    const Eigen::Index rows = onto.g.size() - 6;
    const auto condensed = std::make_shared<CondensedFactor>(
        KeyframeId{1}, others,
        CondensedFactor::Quadratic{onto.H.bottomRightCorner(rows, rows), -onto.g.tail(rows),
                                   onto.cost});
    drop(factorsOfDropped(), KeyframeId{1});
    graph.addFactor(condensed);
  }

  LayeredGraph graph;

 private:
  RandomGeometry random_{5, 5.0};
};

}  // namespace mrpt_sgraphs::test
