// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/transfer.h"

#include <Eigen/Cholesky>
#include <memory>

#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

Matrix6 inverseOf(const Matrix6& matrix) {
  const Matrix6 inverse = matrix.ldlt().solve(Matrix6::Identity());
  return 0.5 * (inverse + inverse.transpose());
}

/// The edge read from its other end.
RelativePoseFactor reversed(const RelativePoseFactor& edge) {
  const Pose T_to_from = edge.T_from_to.inverse();
  const Matrix6 adjoint = adjointOfInverse(T_to_from);
  const Matrix6 covariance = adjoint * inverseOf(edge.information()) * adjoint.transpose();
  return {edge.node(1), edge.node(0), T_to_from, inverseOf(covariance), edge.kind, edge.kernel()};
}

FactorConstPtr movedTo(KeyframeId stays, const WallPairFactor& pair, const LayeredGraph& graph) {
  const Pose T_map_gone = graph.pose(KeyframeId{pair.node(0).value});
  const Pose T_map_stays = graph.pose(stays);
  const WallId face_a{pair.node(1).value};
  const WallId face_b{pair.node(2).value};
  const Plane a_map = graph.plane(face_a);
  const Plane b_map = graph.plane(face_b);
  const double residual_m =
      pair.evaluate(T_map_gone, a_map, b_map, nullptr, nullptr, nullptr).z();
  const Eigen::Vector3d normal_a =
      T_map_stays.linear().transpose() * T_map_gone.linear() * pair.normal_a_base;
  const double thickness_m = inverseTimes(T_map_stays, a_map).distance +
                             inverseTimes(T_map_stays, b_map).distance - residual_m;
  return std::make_shared<WallPairFactor>(stays, face_a, face_b, normal_a.normalized(), thickness_m,
                                          pair.information(), pair.kernel());
}

}  // namespace

RelativePoseFactor transferred(const RelativePoseFactor& edge, KeyframeId gone, KeyframeId stays,
                               const Matrix6& covariance, const LayeredGraph& graph) {
  const RelativePoseFactor from_gone =
      edge.node(0) == NodeId(gone) ? RelativePoseFactor(edge) : reversed(edge);
  const Pose T_stays_gone = graph.pose(stays).inverse() * graph.pose(gone);
  const Matrix6 adjoint = adjointOfInverse(from_gone.T_from_to);
  const Matrix6 total =
      adjoint * covariance * adjoint.transpose() + inverseOf(from_gone.information());
  return {stays, from_gone.node(1), orthonormalized(T_stays_gone * from_gone.T_from_to),
          inverseOf(total), RelativePoseFactor::Kind::kBridge, from_gone.kernel()};
}

void addTransferred(const RelativePoseFactor& edge, LayeredGraph* graph) {
  for (const FactorLink& link : graph->otherFactorsOf(edge.node(0))) {
    const RelativePoseFactor* const earlier =
        keyframeEdge(*graph->factorAt(link.slot).factor);
    if (earlier == nullptr || earlier->kind != RelativePoseFactor::Kind::kBridge) continue;
    const bool is_same = earlier->node(0) == edge.node(0) && earlier->node(1) == edge.node(1);
    const bool is_reversed = earlier->node(0) == edge.node(1) && earlier->node(1) == edge.node(0);
    if (!is_same && !is_reversed) continue;
    const RelativePoseFactor first = is_same ? *earlier : reversed(*earlier);
    const Matrix6 information = first.information() + edge.information();
    const Tangent step = information.ldlt().solve(edge.information() *
                                                  local(first.T_from_to, edge.T_from_to));
    graph->replaceFactor(link.id, std::make_shared<RelativePoseFactor>(
                                      edge.node(0), edge.node(1),
                                      orthonormalized(retract(first.T_from_to, step)), information,
                                      edge.kind, edge.kernel()));
    return;
  }
  graph->addFactor(std::make_shared<RelativePoseFactor>(edge));
}

void carryOver(KeyframeId gone, KeyframeId stays, LayeredGraph* graph) {
  using Kind = RelativePoseFactor::Kind;
  const Topology::Links links = graph->otherFactorsOf(gone);  // they change
  for (const FactorLink& link : links) {
    const FactorConstPtr factor = graph->factor(link.id);
    if (const auto* pair = dynamic_cast<const WallPairFactor*>(factor.get())) {
      graph->replaceFactor(link.id, movedTo(stays, *pair, *graph));
    } else if (const auto* edge = dynamic_cast<const RelativePoseFactor*>(factor.get());
               edge != nullptr && edge->kind == Kind::kRoom) {
      const Pose T_stays_gone = graph->pose(stays).inverse() * graph->pose(gone);
      graph->replaceFactor(link.id, std::make_shared<RelativePoseFactor>(
                                        stays, edge->node(1),
                                        orthonormalized(T_stays_gone * edge->T_from_to),
                                        edge->information(), Kind::kRoom, edge->kernel()));
    }
  }
}

}  // namespace mrpt_sgraphs
