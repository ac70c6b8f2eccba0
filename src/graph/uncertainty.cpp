// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/uncertainty.h"

#include <Eigen/Cholesky>
#include <limits>
#include <queue>
#include <unordered_map>

namespace mrpt_sgraphs {
namespace {

/// How far an uncertainty moves a point ten metres away: what ways are compared by [m^2].
double spread(const Matrix6& covariance) {
  constexpr double kLever_m = 10.0;
  return covariance.topLeftCorner<3, 3>().trace() +
         kLever_m * kLever_m * covariance.bottomRightCorner<3, 3>().trace();
}

/// Two keyframes by their places.
struct Edge {
  const RelativePoseFactor* factor;
  std::size_t from;
  std::size_t to;
};

}  // namespace

std::vector<Matrix6> uncertaintyToNewest(const GraphSnapshot& graph) {
  const SharedVector<KeyframeNode>& keyframes = graph.keyframes;
  const std::size_t count = keyframes.size();
  std::unordered_map<uint64_t, std::size_t> indices;
  for (std::size_t k = 0; k < count; ++k) indices[keyframes[k].id.value] = k;
  std::vector<std::vector<Edge>> neighbours(count);
  for (const StoredFactor& stored : graph.factors) {
    const RelativePoseFactor* const factor = keyframeEdge(*stored.factor);
    if (factor == nullptr) continue;
    const Edge edge{factor, indices.at(factor->node(0).value), indices.at(factor->node(1).value)};
    neighbours[edge.from].push_back(edge);
    neighbours[edge.to].push_back(edge);
  }

  // Dijkstra from the newest
  std::vector<Matrix6> uncertainty(count, Matrix6::Zero());
  std::vector<double> length(count, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  length[count - 1] = 0.0;
  open.push({0.0, count - 1});
  while (!open.empty()) {
    const auto [reached, at] = open.top();
    open.pop();
    if (reached > length[at]) continue;
    for (const Edge& edge : neighbours[at]) {
      const std::size_t next = edge.from == at ? edge.to : edge.from;
      // the edge's covariance is of its `to` end; move it to the newest keyframe
      const Pose T_to_newest =
          keyframes[edge.to].T_map_base.inverse() * keyframes.back().T_map_base;
      const Matrix6 adjoint = adjointOfInverse(T_to_newest);
      const Matrix6 covariance =
          uncertainty[at] + adjoint * edge.factor->information().ldlt().solve(Matrix6::Identity()) *
                                adjoint.transpose();
      const double through = spread(covariance);
      if (through >= length[next]) continue;
      length[next] = through;
      uncertainty[next] = covariance;
      open.push({through, next});
    }
  }
  return uncertainty;
}

}  // namespace mrpt_sgraphs
