// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "mrpt_sgraphs/graph/mrpt_network.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {

inline mrpt::math::CMatrixDouble66 randomMrptInformation(RandomGeometry* random) {
  Matrix6 root;
  for (int k = 0; k < 36; ++k) root(k) = random->number(10.0);
  const Matrix6 product = root * root.transpose() + Matrix6::Identity();
  return mrpt::math::CMatrixDouble66(Matrix6(0.5 * (product + product.transpose())));
}

/// Turned in any way, at coordinates of a map projection, with parallel edges in both directions,
/// full informations, ids with gaps and a root that is not the first.
inline MrptNetwork oddNetwork(unsigned seed, double extent_m = 1e5) {
  RandomGeometry random(seed, extent_m);
  MrptNetwork network;
  const mrpt::graphs::TNodeID ids[] = {2, 3, 17, 40, (1ULL << 60) + 1};
  for (const auto id : ids) network.nodes[id] = toMrpt(random.pose());
  const auto connect = [&](mrpt::graphs::TNodeID from, mrpt::graphs::TNodeID to) {
    MrptNetwork::edge_t edge;
    edge.mean = toMrpt(random.pose());
    edge.cov_inv = randomMrptInformation(&random);
    network.insertEdge(from, to, edge);
  };
  for (int k = 0; k < 3; ++k) connect(2, 3);
  connect(3, 2);
  connect(3, 17);
  connect(40, 17);
  connect(2, (1ULL << 60) + 1);
  network.root = 17;
  return network;
}

/// A walk in circles that drift and tilt, with loop closures to the circle before: what was
/// measured is noisy, the nodes are where the measurements led. Informations are those of the
/// noise, positive definite in each of the blocks of translation and rotation and zero between
/// them.
struct WalkNoise {
  double translation_m = 0.05;
  double rotation_rad = 0.02;
};
inline MrptNetwork circlingWalk(unsigned seed, int nodes = 60, const WalkNoise& noise = {}) {
  constexpr int kNodesARound = 12;
  constexpr double kStep_m = 2.0;
  RandomGeometry random(seed);
  std::vector<Pose> truth{Pose::Identity()};
  for (int k = 1; k < nodes; ++k) {
    Tangent step;
    step << kStep_m, 0.0, 0.1, random.number(0.2), random.number(0.2), 2.0 * M_PI / kNodesARound;
    truth.push_back(retract(truth.back(), step));
  }

  MrptNetwork network;
  const auto measure = [&](int from, int to) {
    Tangent sigma;
    Tangent error;
    for (int k = 0; k < 6; ++k) {
      const double unit = k < 3 ? noise.translation_m : noise.rotation_rad;
      sigma(k) = unit * (1.0 + random.number(0.8));
      error(k) = std::sqrt(3.0) * random.number(sigma(k));
    }
    MrptNetwork::edge_t edge;
    const auto at = [&](int k) { return truth[static_cast<std::size_t>(k)]; };
    edge.mean = toMrpt(retract(at(from).inverse() * at(to), error));
    Matrix6 information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    for (const int block : {0, 3}) {
      const Eigen::Matrix3d turn = random.pose().linear();
      information.block<3, 3>(block, block) =
          turn * information.block<3, 3>(block, block).eval() * turn.transpose();
    }
    edge.cov_inv =
        mrpt::math::CMatrixDouble66(Matrix6(0.5 * (information + information.transpose())));
    network.insertEdge(static_cast<mrpt::graphs::TNodeID>(from),
                       static_cast<mrpt::graphs::TNodeID>(to), edge);
    return fromMrpt(edge.mean);
  };
  Pose reckoned = Pose::Identity();
  network.nodes[0] = toMrpt(reckoned);
  for (int k = 1; k < nodes; ++k) {
    reckoned = reckoned * measure(k - 1, k);
    network.nodes[static_cast<mrpt::graphs::TNodeID>(k)] = toMrpt(reckoned);
    if (k >= kNodesARound && k % 3 == 0) measure(k - kNodesARound, k);
  }
  return network;
}

}  // namespace mrpt_sgraphs::test
