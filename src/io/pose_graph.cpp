// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_graph.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <unordered_map>

#include "mrpt_sgraphs/factors/condensed.h"

namespace mrpt_sgraphs {
namespace {

/// An eigenvalue that is so much smaller than the largest one is zero but for rounding.
constexpr double kSingularShare = 1e-9;

/// What other tools' factorizations need of every direction: 10 m and 10 rad are no news to anyone.
constexpr double kMinInformation = 1e-2;

/// A way of no length is known to 0.1 mm and 0.1 mrad.
constexpr double kMaxInformation = 1e8;

/// How stiff a dropped keyframe hangs on the kept one: 1 mm and 1 mrad.
constexpr double kStiffInformation = 1e6;

using Quadratic = CondensedFactor::Quadratic;

/// What is left on some rows, the others minimized over; along directions of these that cost
/// nothing there is nothing to gain.
Quadratic minimizedOver(const Quadratic& quadratic, const std::vector<Eigen::Index>& kept,
                        const std::vector<Eigen::Index>& others) {
  const auto rows = static_cast<Eigen::Index>(kept.size());
  const auto out = static_cast<Eigen::Index>(others.size());
  Quadratic result{Eigen::MatrixXd(rows, rows), Eigen::VectorXd(rows), quadratic.c};
  Eigen::MatrixXd across(rows, out);
  Eigen::MatrixXd Lambda_others(out, out);
  Eigen::VectorXd eta_others(out);
  for (Eigen::Index i = 0; i < rows; ++i) {
    result.eta[i] = quadratic.eta[kept[i]];
    for (Eigen::Index j = 0; j < rows; ++j)
      result.Lambda(i, j) = quadratic.Lambda(kept[i], kept[j]);
    for (Eigen::Index j = 0; j < out; ++j) across(i, j) = quadratic.Lambda(kept[i], others[j]);
  }
  for (Eigen::Index i = 0; i < out; ++i) {
    eta_others[i] = quadratic.eta[others[i]];
    for (Eigen::Index j = 0; j < out; ++j) {
      Lambda_others(i, j) = quadratic.Lambda(others[i], others[j]);
    }
  }
  if (out == 0) return result;

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Lambda_others);
  const Eigen::VectorXd& values = solver.eigenvalues();
  const double least = kSingularShare * values[out - 1];
  const Eigen::VectorXd inverse =
      values.unaryExpr([least](double value) { return value > least ? 1.0 / value : 0.0; });
  const Eigen::MatrixXd across_turned = across * solver.eigenvectors();
  const Eigen::VectorXd eta_turned = solver.eigenvectors().transpose() * eta_others;
  const Eigen::MatrixXd gain = across_turned * inverse.asDiagonal();
  result.Lambda -= gain * across_turned.transpose();
  result.eta -= gain * eta_turned;
  result.c -= eta_turned.dot(inverse.cwiseProduct(eta_turned));
  return result;
}

/// A condensed factor's quadratic on its keyframes alone.
struct KeyframesOfFactor {
  std::vector<const CondensedFactor::Other*> others;  ///< Six rows each.
  Quadratic quadratic;

  explicit KeyframesOfFactor(const CondensedFactor& factor) {
    std::vector<Eigen::Index> poses;
    std::vector<Eigen::Index> rest;
    Eigen::Index row = 0;
    for (const CondensedFactor::Other& other : factor.others()) {
      const bool is_keyframe = other.node.layer == Layer::kKeyframe;
      if (is_keyframe) others.push_back(&other);
      for (int k = 0; k < tangentSize(other.node.layer); ++k) {
        (is_keyframe ? poses : rest).push_back(row++);
      }
    }
    quadratic = minimizedOver(factor.quadratic(), poses, rest);
  }

  Quadratic marginal(std::size_t index) const {
    std::vector<Eigen::Index> own;
    std::vector<Eigen::Index> rest;
    for (Eigen::Index row = 0; row < quadratic.eta.size(); ++row) {
      (row / 6 == static_cast<Eigen::Index>(index) ? own : rest).push_back(row);
    }
    return minimizedOver(quadratic, own, rest);
  }
};

/// The matrix with other eigenvalues.
template <typename Function>
Matrix6 withEigenvalues(const Eigen::SelfAdjointEigenSolver<Matrix6>& solver, Function function) {
  return solver.eigenvectors() * solver.eigenvalues().unaryExpr(function).asDiagonal() *
         solver.eigenvectors().transpose();
}

PoseEdge edgeTo(const CondensedFactor::Other& other, const Quadratic& marginal, KeyframeId kept) {
  const Pose& T_kept_seen = std::get<Pose>(other.seen_kept);
  PoseEdge edge{kept, KeyframeId{other.node.value}, T_kept_seen, marginal.Lambda};
  Eigen::SelfAdjointEigenSolver<Matrix6> solver(edge.information);
  const double least = kSingularShare * solver.eigenvalues()[5];
  if (solver.eigenvalues()[0] <= least && other.way_covariance) {
    const Eigen::SelfAdjointEigenSolver<Matrix6> way(*other.way_covariance);
    edge.information =
        withEigenvalues(way, [](double x) { return 1.0 / std::max(x, 1.0 / kMaxInformation); });
    solver.compute(edge.information);
  } else {
    const auto inverse = [least](double x) { return x > least ? 1.0 / x : 0.0; };
    edge.T_from_to = retract(T_kept_seen, withEigenvalues(solver, inverse) * marginal.eta);
  }
  const double floor = std::max(kMinInformation, kSingularShare * solver.eigenvalues()[5]);
  if (solver.eigenvalues()[0] < floor) {
    edge.information = withEigenvalues(solver, [floor](double x) { return std::max(x, floor); });
  }
  return edge;
}

}  // namespace

std::vector<PoseEdge> poseGraph(const GraphSnapshot& graph) {
  std::vector<PoseEdge> edges;
  for (const StoredFactor& stored : graph.factors) {
    if (const RelativePoseFactor* const edge = keyframeEdge(*stored.factor)) {
      edges.push_back({KeyframeId{edge->node(0).value}, KeyframeId{edge->node(1).value},
                       edge->T_from_to, edge->information()});
    } else if (const auto* const condensed =
                   dynamic_cast<const CondensedFactor*>(stored.factor.get())) {
      const KeyframesOfFactor keyframes(*condensed);
      for (std::size_t k = 0; k < keyframes.others.size(); ++k) {
        edges.push_back(edgeTo(*keyframes.others[k], keyframes.marginal(k), condensed->kept()));
      }
    }
  }

  std::unordered_map<KeyframeId, const Pose*> poses;
  for (const KeyframeNode& keyframe : graph.keyframes) poses[keyframe.id] = &keyframe.T_map_base;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (!keyframe.marginalized || !keyframe.representative) continue;
    edges.push_back({*keyframe.representative, keyframe.id,
                     poses.at(*keyframe.representative)->inverse() * keyframe.T_map_base,
                     kStiffInformation * Matrix6::Identity()});
  }
  return edges;
}

}  // namespace mrpt_sgraphs
