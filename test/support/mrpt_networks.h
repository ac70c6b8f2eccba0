// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace mrpt_sgraphs::test
