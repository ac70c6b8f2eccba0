// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>

#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "peer.h"

/// MRPT's own optimizer, optimize_graph_spa_levmarq, on the 3D pose graph of a .g2o file.
///
///     mrpt_pose_graph FILE.g2o [--repeat N] [--out FILE]
///
/// Its residual is the rotation vector where g2o's is the vector part of the quaternion, half as long:
/// the information of the rotation is scaled so that the two costs agree for small residuals. It is
/// put down in the order in which the optimizer multiplies it, x y z and about x y z.
namespace mrpt_sgraphs::peers {
namespace {

using Network = mrpt::graphs::CNetworkOfPoses3DInf;

mrpt::poses::CPose3D toMrpt(const Pose& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

Solve build(const Options&, IndexedGraph* indexed) {
  const auto network = std::make_shared<Network>();
  for (const GraphFile::Keyframe& keyframe : indexed->graph.keyframes) {
    network->nodes[keyframe.id.value] = toMrpt(keyframe.T_map_base);
  }
  network->root = indexed->graph.keyframes[indexed->held].id.value;
  Tangent scale;
  scale << 1.0, 1.0, 1.0, 0.5, 0.5, 0.5;
  for (const FactorConstPtr& factor : indexed->graph.factors) {
    const auto* edge = dynamic_cast<const RelativePoseQuaternionFactor*>(factor.get());
    if (edge == nullptr) throw std::runtime_error("MRPT optimizes pose graphs only");
    Network::edge_t measured;
    measured.mean = toMrpt(edge->T_from_to);
    measured.cov_inv = (scale.asDiagonal() * edge->information() * scale.asDiagonal()).eval();
    network->insertEdge(edge->node(0).value, edge->node(1).value, measured);
  }

  return [network, indexed] {
    mrpt::graphslam::TResultInfoSpaLevMarq result;
    mrpt::containers::yaml parameters;
    parameters["max_iterations"] = 100;
    mrpt::graphslam::optimize_graph_spa_levmarq(*network, result, nullptr, parameters);
    for (GraphFile::Keyframe& keyframe : indexed->graph.keyframes) {
      keyframe.T_map_base.matrix() = network->nodes.at(keyframe.id.value)
                                         .getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>()
                                         .asEigen();
    }
    return Solved{static_cast<int>(result.num_iters), true};  // it does not say whether it did
  };
}

}  // namespace
}  // namespace mrpt_sgraphs::peers

int main(int argc, char** argv) {
  using namespace mrpt_sgraphs::peers;
  return guarded([&] { return run(optionsOf(argc, argv), build); });
}
