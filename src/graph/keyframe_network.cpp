// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/keyframe_network.h"

namespace mrpt_sgraphs {
namespace {

mrpt::poses::CPose3D toMrpt(const Pose& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

}  // namespace

/// MRPT keeps x y z yaw pitch roll; ours is x y z and the rotation about x y z. Its optimizer
/// multiplies the former with the latter, so the permutation is what makes it do the right thing;
/// it is exact near identity and its own inverse.
Matrix6 toMrptInformation(const Pose& /*T_from_to*/, const Matrix6& information) {
  constexpr int kOrder[6] = {0, 1, 2, 5, 4, 3};
  Matrix6 permuted;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      permuted(row, column) = information(kOrder[row], kOrder[column]);
    }
  }
  return permuted;
}

Pose KeyframeNetwork::pose(std::size_t slot) const {
  const mrpt::poses::CPose3D& pose = *nodes_[slot].T_map_base;
  Pose T = Pose::Identity();
  T.linear() = pose.getRotationMatrix().asEigen();
  T.translation() << pose.x(), pose.y(), pose.z();
  return T;
}

void KeyframeNetwork::setPose(std::size_t slot, const Pose& T_map_base) {
  *nodes_[slot].T_map_base = toMrpt(T_map_base);
}

void KeyframeNetwork::addNode(KeyframeId id, const Pose& T_map_base) {
  if (nodes_.empty()) network_->root = id.value;
  nodes_.push_back({id.value, &network_->nodes[id.value]});
  setPose(nodes_.size() - 1, T_map_base);
}

void KeyframeNetwork::eraseNode(std::size_t slot) {
  network_->nodes.erase(nodes_[slot].id);
  nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(slot));
  network_->root = nodes_.empty() ? mrpt::graphs::INVALID_NODEID : nodes_.front().id;
}

KeyframeNetwork::Edge KeyframeNetwork::addEdge(const RelativePoseFactor& factor) {
  Network::edge_t measurement;
  measurement.mean = toMrpt(factor.T_from_to);
  measurement.cov_inv =
      mrpt::math::CMatrixDouble66(toMrptInformation(factor.T_from_to, factor.information()));
  const auto ends = std::make_pair(factor.node(0).value, factor.node(1).value);
  return network_->edges.insert({ends, std::move(measurement)});
}

}  // namespace mrpt_sgraphs
