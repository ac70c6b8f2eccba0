// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/certain_ways.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace mrpt_sgraphs {
namespace {

/// How far an uncertainty moves a point ten metres away: what ways are compared by [m^2].
double spread(const Matrix6& covariance) {
  constexpr double kLever_m = 10.0;
  return covariance.topLeftCorner<3, 3>().trace() +
         kLever_m * kLever_m * covariance.bottomRightCorner<3, 3>().trace();
}

}  // namespace

std::vector<std::optional<Matrix6>> certainWays(std::size_t goal, const std::vector<Way>& ways,
                                                const std::vector<Pose>& T_map_places) {
  const std::size_t count = T_map_places.size();
  std::vector<std::vector<const Way*>> ways_of(count);
  for (const Way& way : ways) {
    ways_of[way.from].push_back(&way);
    ways_of[way.to].push_back(&way);
  }
  // Dijkstra from the goal
  std::vector<std::optional<Matrix6>> uncertainty(count);
  std::vector<double> length(count, std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  uncertainty[goal] = Matrix6::Zero();
  length[goal] = 0.0;
  open.push({0.0, goal});
  while (!open.empty()) {
    const auto [reached, at] = open.top();
    open.pop();
    if (reached > length[at]) continue;
    for (const Way* way : ways_of[at]) {
      const std::size_t next = way->from == at ? way->to : way->from;
      // the covariance is of the way's `to` end; move it to the goal
      const Matrix6 adjoint =
          adjointOfInverse(T_map_places[way->to].inverse() * T_map_places[goal]);
      const Matrix6 covariance =
          *uncertainty[at] + adjoint * way->covariance * adjoint.transpose();
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
