// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/keyframe_graph.h"

#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {
namespace {

mrpt::poses::CPose3D toMrpt(const Pose& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

Pose fromMrpt(const mrpt::poses::CPose3D& pose) {
  Pose T = Pose::Identity();
  T.linear() = pose.getRotationMatrix().asEigen();
  T.translation() << pose.x(), pose.y(), pose.z();
  return T;
}

}  // namespace

KeyframeId KeyframeGraph::add(double stamp_s, const Pose& T_map_base, const Pose& T_odom_base,
                              const Cloud::ConstPtr& cloud) {
  const KeyframeId id{next_id_++};
  if (details_.empty()) network_.root = id.value;
  details_[id] = Details{stamp_s, T_odom_base, cloud};
  network_.nodes[id.value] = toMrpt(T_map_base);
  return id;
}

void KeyframeGraph::add(const RelativePoseEdge& edge) {
  if (details_.count(edge.from) == 0 || details_.count(edge.to) == 0 || edge.from == edge.to) {
    throw std::invalid_argument("edge between keyframes " + std::to_string(edge.from.value) +
                                " and " + std::to_string(edge.to.value) +
                                ", which are not two of the graph");
  }
  if (!edge.T_from_to.matrix().allFinite() || !edge.information.allFinite()) {
    throw std::invalid_argument("edge between keyframes " + std::to_string(edge.from.value) +
                                " and " + std::to_string(edge.to.value) + " is not finite");
  }
  Network::edge_t measurement;
  measurement.mean = toMrpt(edge.T_from_to);
  measurement.cov_inv = mrpt::math::CMatrixDouble66(permutedInformation(edge.information));
  const auto inserted =
      network_.edges.insert({{edge.from.value, edge.to.value}, std::move(measurement)});
  edges_.push_back({edge.kind, inserted});
}

Pose KeyframeGraph::pose(KeyframeId id) const { return fromMrpt(network_.nodes.at(id.value)); }

void KeyframeGraph::setPose(KeyframeId id, const Pose& T_map_base) {
  static_cast<mrpt::poses::CPose3D&>(network_.nodes.at(id.value)) = toMrpt(T_map_base);
}

KeyframeNode KeyframeGraph::node(KeyframeId id) const {
  const Details& details = details_.at(id);
  return {id, details.stamp_s, pose(id), details.T_odom_base, details.cloud};
}

RelativePoseEdge KeyframeGraph::edge(std::size_t index) const {
  const StoredEdge& stored = edges_.at(index);
  const auto& [ends, measurement] = *stored.in_network;
  RelativePoseEdge edge;
  edge.from = KeyframeId{ends.first};
  edge.to = KeyframeId{ends.second};
  edge.T_from_to = fromMrpt(measurement.mean);
  edge.information = permutedInformation(measurement.cov_inv.asEigen());
  edge.kind = stored.kind;
  return edge;
}

std::vector<KeyframeId> KeyframeGraph::ids() const {
  std::vector<KeyframeId> ids;
  for (const auto& [id, details] : details_) ids.push_back(id);
  return ids;
}

}  // namespace mrpt_sgraphs
