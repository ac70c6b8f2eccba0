// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/uncertainty.h"

#include <Eigen/Cholesky>
#include <unordered_map>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/graph/certain_ways.h"

namespace mrpt_sgraphs {

std::vector<Matrix6> uncertaintyToNewest(const GraphSnapshot& graph) {
  const SharedVector<KeyframeNode>& keyframes = graph.keyframes;
  const std::size_t count = keyframes.size();
  // dropped keyframes are known as well as those that they move with
  std::unordered_map<uint64_t, std::size_t> places;
  std::vector<Pose> T_map_places;
  for (const KeyframeNode& keyframe : keyframes) {
    if (keyframe.marginalized) continue;
    places[keyframe.id.value] = T_map_places.size();
    T_map_places.push_back(keyframe.T_map_base);
  }
  std::vector<Way> ways;
  for (const StoredFactor& stored : graph.factors) {
    const Factor& factor = *stored.factor;
    if (const RelativePoseFactor* const edge = keyframeEdge(factor)) {
      ways.push_back({places.at(edge->node(0).value), places.at(edge->node(1).value),
                      edge->information().ldlt().solve(Matrix6::Identity())});
    } else if (const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor)) {
      for (const CondensedFactor::Other& other : condensed->others()) {
        if (!other.way_covariance) continue;
        ways.push_back({places.at(condensed->kept().value), places.at(other.node.value),
                        *other.way_covariance});
      }
    }
  }
  const KeyframeNode& newest = keyframes.back();
  const std::vector<std::optional<Matrix6>> found =
      certainWays(places.at(newest.representative.value_or(newest.id).value), ways, T_map_places);

  std::vector<Matrix6> uncertainty(count, Matrix6::Zero());
  for (std::size_t k = 0; k < count; ++k) {
    const KeyframeId stands_for = keyframes[k].representative.value_or(keyframes[k].id);
    uncertainty[k] = found[places.at(stands_for.value)].value_or(Matrix6::Zero());
  }
  return uncertainty;
}

}  // namespace mrpt_sgraphs
