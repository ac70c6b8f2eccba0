// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

/// Stamps of a TUM file are rounded.
constexpr double kSameStamp_s = 1e-5;

bool isStandIn(const Factor& factor) {
  const auto* const edge = dynamic_cast<const RelativePoseFactor*>(&factor);
  return (edge != nullptr && edge->kind == RelativePoseFactor::Kind::kBridge) ||
         dynamic_cast<const CondensedFactor*>(&factor) != nullptr;
}

std::vector<const Factor*> factorsOf(const GraphSnapshot& graph) {
  std::vector<const Factor*> factors;
  for (const StoredFactor& stored : graph.factors) factors.push_back(stored.factor.get());
  return factors;
}

/// Files that were written before there was a shelf have stand-ins alone.
void requireShelf(const GraphSnapshot& graph) {
  std::set<KeyframeId> kept;
  for (const ShelvedFactor& shelved : graph.shelved) {
    if (shelved.kept) kept.insert(*shelved.kept);
  }
  for (const StoredFactor& stored : graph.factors) {
    const auto* const condensed = dynamic_cast<const CondensedFactor*>(stored.factor.get());
    const bool is_here = condensed != nullptr
                             ? kept.count(condensed->kept()) != 0
                             : !isStandIn(*stored.factor) || !graph.shelved.empty();
    if (is_here) continue;
    throw std::runtime_error(
        "the graph lacks the factors that others stand for: nothing tells what "
        "the one of " +
        nameOf(stored.factor->node(0)) + " was made of");
  }
}

/// The one that is fixed, and that errors are relative to.
const KeyframeNode& firstActive(const GraphSnapshot& graph) {
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (!keyframe.marginalized) return keyframe;
  }
  throw std::runtime_error("no keyframe is active");
}

/// What a compressed graph has of the full one, but for the keyframe that is fixed.
std::vector<NodeId> commonNodes(const GraphSnapshot& graph, KeyframeId fixed) {
  std::vector<NodeId> nodes;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (!keyframe.marginalized && keyframe.id != fixed) nodes.emplace_back(keyframe.id);
  }
  for (const WallNode& wall : graph.walls) nodes.emplace_back(wall.id);
  for (const RoomNode& room : graph.rooms) nodes.emplace_back(room.id);
  for (const FloorNode& floor : graph.floors) nodes.emplace_back(floor.id);
  return nodes;
}

ModelSize sizeOf(const LinearModel& model, std::size_t factors) {
  const auto& nodes = model.tangents().nodes;
  const auto keyframes = std::count_if(nodes.begin(), nodes.end(),
                                       [](NodeId node) { return node.layer == Layer::kKeyframe; });
  return {static_cast<std::size_t>(keyframes) + 1, factors, model.tangents().rows};  // 1: fixed
}

/// Sorted by time; the pose at a stamp if there are poses around it.
class TruthAtStamp {
 public:
  TruthAtStamp(Trajectory truth, double max_gap_s)
      : truth_(std::move(truth)), max_gap_s_(max_gap_s) {
    std::stable_sort(truth_.begin(), truth_.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
  }

  std::optional<Pose> operator()(double stamp_s) const {
    const auto after =
        std::lower_bound(truth_.begin(), truth_.end(), stamp_s - kSameStamp_s,
                         [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
    if (after == truth_.end()) return std::nullopt;
    if (after->stamp_s <= stamp_s + kSameStamp_s) return after->T_world_body;
    if (after == truth_.begin()) return std::nullopt;
    const StampedPose& before = *std::prev(after);
    const double gap_s = after->stamp_s - before.stamp_s;
    if (gap_s > max_gap_s_) return std::nullopt;
    return interpolate(before.T_world_body, after->T_world_body,
                       (stamp_s - before.stamp_s) / gap_s);
  }

 private:
  Trajectory truth_;
  double max_gap_s_;
};

NormalizedErrors summary(int dof, const std::vector<double>& values) {
  return {dof, mean(values), quantile(values, 0.5), quantile(values, 0.95)};
}

}  // namespace

std::vector<const Factor*> originalFactors(const GraphSnapshot& graph) {
  requireShelf(graph);
  std::vector<const Factor*> factors;
  for (const StoredFactor& stored : graph.factors) {
    if (!isStandIn(*stored.factor)) factors.push_back(stored.factor.get());
  }
  for (const ShelvedFactor& shelved : graph.shelved) {
    if (!isStandIn(*shelved.factor)) factors.push_back(shelved.factor.get());
  }
  return factors;
}

CompressionReport compareWithOriginal(const GraphSnapshot& graph) {
  const KeyframeId fixed = firstActive(graph).id;
  const std::vector<const Factor*> original = originalFactors(graph);
  const LinearModel full(graph, original, fixed);
  const LinearModel compressed(graph, factorsOf(graph), fixed);

  CompressionReport report;
  report.full = sizeOf(full, original.size());
  report.compressed = sizeOf(compressed, graph.factors.size());
  std::vector<NodeId> common;
  for (const NodeId node : commonNodes(graph, fixed)) {
    if (compressed.tangents().contains(node)) {
      common.push_back(node);
    } else if (full.tangents().contains(node)) {
      report.lost.push_back(node);
    }
  }
  report.divergence = divergence(full.marginal(common), compressed.marginal(common));
  return report;
}

PoseConsistency posesAgainstTruth(const GraphSnapshot& graph, const Trajectory& truth,
                                  double max_gap_s) {
  const KeyframeNode& first = firstActive(graph);
  const LinearModel model(graph, factorsOf(graph), first.id);
  const TruthAtStamp true_pose(truth, max_gap_s);
  const std::optional<Pose> T_truth_first = true_pose(first.stamp_s);
  if (!T_truth_first) {
    throw std::runtime_error("the first keyframe, at " + std::to_string(first.stamp_s) +
                             " s, has no truth");
  }

  PoseConsistency result;
  std::vector<KeyframeId> keyframes;
  std::vector<Tangent> errors;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (!model.tangents().contains(keyframe.id) || keyframe.marginalized) continue;
    const std::optional<Pose> T_truth_base = true_pose(keyframe.stamp_s);
    if (!T_truth_base) {
      ++result.without_truth;
      continue;
    }
    keyframes.push_back(keyframe.id);
    errors.push_back(local(T_truth_first->inverse() * *T_truth_base,
                           first.T_map_base.inverse() * keyframe.T_map_base));
  }
  const std::vector<Matrix6> covariances = model.covariances(keyframes);
  std::vector<double> pose;
  std::vector<double> position;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const Eigen::Vector3d off_m = errors[k].head<3>();
    const Eigen::Matrix3d covariance_m = covariances[k].topLeftCorner<3, 3>();
    pose.push_back(errors[k].dot(covariances[k].ldlt().solve(errors[k])));
    position.push_back(off_m.dot(covariance_m.ldlt().solve(off_m)));
  }
  result.keyframes = keyframes.size();
  result.pose = summary(6, pose);
  result.position = summary(3, position);
  return result;
}

}  // namespace mrpt_sgraphs
