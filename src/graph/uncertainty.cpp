// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/uncertainty.h"

#include <Eigen/Cholesky>
#include <limits>
#include <queue>

namespace mrpt_sgraphs {
namespace {

/// How far an uncertainty moves a point ten metres away: what ways are compared by [m^2].
double spread(const Matrix6& covariance) {
  constexpr double kLever_m = 10.0;
  return covariance.topLeftCorner<3, 3>().trace() +
         kLever_m * kLever_m * covariance.bottomRightCorner<3, 3>().trace();
}

}  // namespace

std::vector<Matrix6> uncertaintyToNewest(const std::vector<KeyframeNode>& keyframes,
                                         const std::vector<RelativePoseEdge>& edges) {
  const std::size_t count = keyframes.size();
  const uint64_t first = keyframes.front().id.value;
  std::vector<std::vector<const RelativePoseEdge*>> neighbours(count);
  for (const RelativePoseEdge& edge : edges) {
    neighbours[edge.from.value - first].push_back(&edge);
    neighbours[edge.to.value - first].push_back(&edge);
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
    for (const RelativePoseEdge* edge : neighbours[at]) {
      const std::size_t from = edge->from.value - first;
      const std::size_t to = edge->to.value - first;
      const std::size_t next = from == at ? to : from;
      // the edge's covariance is of its `to` end; move it to the newest keyframe
      const Pose T_to_newest = keyframes[to].T_map_base.inverse() * keyframes.back().T_map_base;
      const Matrix6 adjoint = adjointOfInverse(T_to_newest);
      const Matrix6 covariance =
          uncertainty[at] +
          adjoint * edge->information.ldlt().solve(Matrix6::Identity()) * adjoint.transpose();
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
