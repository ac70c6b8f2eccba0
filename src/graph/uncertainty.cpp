// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/uncertainty.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <unordered_map>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/graph/certain_ways.h"

namespace mrpt_sgraphs {

std::vector<Matrix6> uncertaintyToNewest(const GraphSnapshot& graph) {
  const SharedVector<KeyframeNode>& keyframes = graph.keyframes;
  const std::size_t count = keyframes.size();
  // dropped keyframes are known as well as those that they move with, unless an edge knows better
  std::unordered_map<uint64_t, std::size_t> places;
  std::vector<Pose> T_map_places;
  const auto add = [&](const KeyframeNode& keyframe) {
    places[keyframe.id.value] = T_map_places.size();
    T_map_places.push_back(keyframe.T_map_base);
  };
  for (const KeyframeNode& keyframe : keyframes) {
    if (!keyframe.representative) add(keyframe);
  }
  const auto placeOf = [&](NodeId id) {
    const auto found = places.find(id.value);
    if (found != places.end()) return found->second;
    const auto keyframe =
        std::find_if(keyframes.begin(), keyframes.end(),
                     [id](const KeyframeNode& node) { return node.id.value == id.value; });
    add(*keyframe);
    return T_map_places.size() - 1;
  };
  std::vector<Way> ways;
  for (const StoredFactor& stored : graph.factors) {
    const Factor& factor = *stored.factor;
    if (const RelativePoseFactor* const edge = keyframeEdge(factor)) {
      ways.push_back({placeOf(edge->node(0)), placeOf(edge->node(1)),
                      edge->information().ldlt().solve(Matrix6::Identity())});
    } else if (const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor)) {
      for (const CondensedFactor::Other& other : condensed->others()) {
        if (!other.way_covariance) continue;
        ways.push_back({placeOf(condensed->kept()), placeOf(other.node), *other.way_covariance});
      }
    }
  }
  const auto standsFor = [&](const KeyframeNode& keyframe) {
    const auto found = places.find(keyframe.id.value);
    return found != places.end() ? found->second : placeOf(*keyframe.representative);
  };
  const std::size_t newest = standsFor(keyframes.back());
  const std::vector<std::optional<Matrix6>> found = certainWays(newest, ways, T_map_places);

  std::vector<Matrix6> uncertainty(count, Matrix6::Zero());
  for (std::size_t k = 0; k < count; ++k) {
    uncertainty[k] = found[standsFor(keyframes[k])].value_or(Matrix6::Zero());
  }
  return uncertainty;
}

}  // namespace mrpt_sgraphs
