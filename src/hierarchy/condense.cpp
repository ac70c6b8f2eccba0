// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/condense.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>
#include <unordered_map>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/graph/certain_ways.h"

namespace mrpt_sgraphs {
namespace {

/// Some factors linearized together, with one keyframe at the origin so that large coordinates do
/// not cancel: cost + 2 g' delta + delta' H delta.
class LocalSystem {
 public:
  /// @param first  Their rows come first, in this order; then the origin's, then by node.
  LocalSystem(const std::vector<FactorConstPtr>& factors, KeyframeId origin,
              const std::vector<KeyframeId>& first, const LayeredGraph& graph) {
    const Pose T_origin_map = graph.pose(origin).inverse();
    for (const KeyframeId id : first) add(id, T_origin_map, graph);
    add(origin, T_origin_map, graph);
    std::set<NodeId> others;
    for (const FactorConstPtr& factor : factors) {
      for (int k = 0; k < factor->nodeCount(); ++k) others.insert(factor->node(k));
    }
    for (const NodeId node : others) add(node, T_origin_map, graph);
    H = Eigen::MatrixXd::Zero(rows_, rows_);
    g = Eigen::VectorXd::Zero(rows_);
    for (const FactorConstPtr& factor : factors) add(*factor);
  }

  const std::vector<NodeId>& nodes() const { return nodes_; }
  Eigen::Index row(NodeId node) const { return places_.at(node).row; }
  const Pose& pose(NodeId node) const { return places_.at(node).pose; }
  const Plane& plane(NodeId node) const { return places_.at(node).plane; }

  Eigen::MatrixXd H;  ///< Its lower triangle.
  Eigen::VectorXd g;
  double cost = 0.0;

 private:
  struct Place {
    Eigen::Index row = 0;
    Pose pose;  ///< In the origin's frame, as the plane.
    Plane plane;
  };

  void add(NodeId node, const Pose& T_origin_map, const LayeredGraph& graph) {
    const auto [entry, is_new] = places_.try_emplace(node);
    if (!is_new) return;
    Place& place = entry->second;
    place.row = rows_;
    const NodeHandle handle = graph.handle(node);
    if (isPlane(node.layer)) {
      place.plane = T_origin_map * graph.plane(handle);
    } else {
      place.pose = orthonormalized(T_origin_map * graph.pose(handle));
    }
    rows_ += tangentSize(node.layer);
    nodes_.push_back(node);
  }

  void add(const Factor& factor) {
    const auto count = static_cast<std::size_t>(factor.nodeCount());
    std::vector<VariableView> values(count);
    std::vector<Eigen::Index> rows(count);
    for (std::size_t k = 0; k < count; ++k) {
      const NodeId node = factor.node(static_cast<int>(k));
      const Place& place = places_.at(node);
      values[k] = isPlane(node.layer) ? VariableView(place.plane) : VariableView(place.pose);
      rows[k] = place.row;
    }
    const Eigen::Index tangents = factor.tangentRows();
    H_one_.resize(tangents, tangents);
    g_one_.resize(tangents);
    cost += factor.linearize(values.data(), H_one_.data(), g_one_.data());
    Eigen::Index column = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const Eigen::Index columns = tangentSize(factor.node(static_cast<int>(j)).layer);
      g.segment(rows[j], columns) += g_one_.segment(column, columns);
      H.block(rows[j], rows[j], columns, columns).triangularView<Eigen::Lower>() +=
          H_one_.block(column, column, columns, columns);
      Eigen::Index row = column + columns;
      for (std::size_t k = j + 1; k < count; ++k) {
        const Eigen::Index size = tangentSize(factor.node(static_cast<int>(k)).layer);
        const auto block = H_one_.block(row, column, size, columns);
        if (rows[k] > rows[j]) {
          H.block(rows[k], rows[j], size, columns) += block;
        } else {
          H.block(rows[j], rows[k], columns, size) += block.transpose();
        }
        row += size;
      }
      column += columns;
    }
  }

  std::vector<NodeId> nodes_;
  std::unordered_map<NodeId, Place> places_;
  Eigen::Index rows_ = 0;
  Eigen::MatrixXd H_one_;
  Eigen::VectorXd g_one_;
};

/// How well relative poses alone tell where the keyframes of `nodes` are, from the kept one.
std::unordered_map<NodeId, Matrix6> waysFrom(KeyframeId kept,
                                             const std::vector<FactorConstPtr>& factors,
                                             const LocalSystem& system) {
  std::unordered_map<NodeId, std::size_t> places;
  std::vector<Pose> poses;
  for (const NodeId node : system.nodes()) {
    if (node.layer != Layer::kKeyframe) continue;
    places[node] = poses.size();
    poses.push_back(system.pose(node));
  }
  std::vector<Way> ways;
  for (const FactorConstPtr& factor : factors) {
    if (const RelativePoseFactor* const edge = keyframeEdge(*factor)) {
      ways.push_back({places.at(edge->node(0)), places.at(edge->node(1)),
                      edge->information().ldlt().solve(Matrix6::Identity())});
    } else if (const auto* earlier = dynamic_cast<const CondensedFactor*>(factor.get())) {
      for (const CondensedFactor::Other& other : earlier->others()) {
        if (!other.way_covariance) continue;
        ways.push_back({places.at(earlier->kept()), places.at(other.node), *other.way_covariance});
      }
    }
  }
  const auto found = certainWays(places.at(kept), ways, poses);
  std::unordered_map<NodeId, Matrix6> covariances;
  for (const auto& [node, place] : places) {
    if (!found[place]) continue;
    const Matrix6 adjoint = adjointOfInverse(system.pose(node));  // from the kept one's end
    covariances[node] = adjoint * *found[place] * adjoint.transpose();
  }
  return covariances;
}

}  // namespace

std::shared_ptr<const CondensedFactor> condense(const std::vector<FactorConstPtr>& factors,
                                                KeyframeId kept,
                                                const std::vector<KeyframeId>& dropped,
                                                const LayeredGraph& graph) {
  LocalSystem system(factors, kept, dropped, graph);
  const Eigen::Index gone = system.row(kept);
  const Eigen::Index left = system.H.rows() - gone;
  Eigen::MatrixXd S = system.H.bottomRightCorner(left, left);
  Eigen::VectorXd s = system.g.tail(left);
  double cost = system.cost;
  if (gone > 0) {
    const Eigen::LLT<Eigen::MatrixXd> llt(system.H.topLeftCorner(gone, gone));
    if (llt.info() != Eigen::Success) return nullptr;
    Eigen::MatrixXd Y = system.H.bottomLeftCorner(left, gone).transpose();
    llt.matrixL().solveInPlace(Y);
    Eigen::VectorXd y = system.g.head(gone);
    llt.matrixL().solveInPlace(y);
    S.selfadjointView<Eigen::Lower>().rankUpdate(Y.transpose(), -1.0);
    s.noalias() -= Y.transpose() * y;
    cost -= y.squaredNorm();
  }
  // the rows of the kept one follow from the others: nothing changes where all move together
  const Eigen::Index rows = left - tangentSize(Layer::kKeyframe);
  CondensedFactor::Quadratic quadratic;
  quadratic.Lambda = S.bottomRightCorner(rows, rows).selfadjointView<Eigen::Lower>();
  quadratic.eta = -s.tail(rows);
  quadratic.c = cost;

  const auto ways = waysFrom(kept, factors, system);
  std::vector<CondensedFactor::Other> others;
  for (std::size_t k = dropped.size() + 1; k < system.nodes().size(); ++k) {
    const NodeId node = system.nodes()[k];
    CondensedFactor::Other other{node, Pose::Identity()};
    if (isPlane(node.layer)) {
      other.seen_kept = system.plane(node);
    } else {
      other.seen_kept = system.pose(node);
      const auto way = ways.find(node);
      if (way != ways.end()) other.way_covariance = way->second;
    }
    others.push_back(std::move(other));
  }
  return std::make_shared<CondensedFactor>(kept, std::move(others), std::move(quadratic));
}

std::shared_ptr<const CondensedFactor> condenseInSteps(std::vector<FactorConstPtr> factors,
                                                       KeyframeId kept,
                                                       const std::vector<KeyframeId>& dropped,
                                                       const LayeredGraph& graph) {
  constexpr std::size_t kAtATime = 10;
  std::shared_ptr<const CondensedFactor> condensed;
  for (std::size_t first = 0; first < dropped.size(); first += kAtATime) {
    const std::size_t last = std::min(first + kAtATime, dropped.size());
    const std::vector<KeyframeId> some(dropped.begin() + static_cast<std::ptrdiff_t>(first),
                                       dropped.begin() + static_cast<std::ptrdiff_t>(last));
    const std::set<NodeId> going(some.begin(), some.end());
    const auto later = std::stable_partition(
        factors.begin(), factors.end(), [&](const FactorConstPtr& factor) {
          if (last == dropped.size() || factor == condensed) return true;
          for (int k = 0; k < factor->nodeCount(); ++k) {
            if (going.count(factor->node(k)) != 0) return true;
          }
          return false;
        });
    std::vector<FactorConstPtr> now(factors.begin(), later);
    condensed = condense(now, kept, some, graph);
    if (condensed == nullptr) return nullptr;
    factors.erase(factors.begin(), later);
    factors.push_back(condensed);
  }
  return condensed;
}

CondensedFactor conditioned(const CondensedFactor& factor, const VariableView* values,
                            const std::vector<bool>& is_fixed) {
  const CondensedFactor::Quadratic& all = factor.quadratic();
  const Pose& T_map_kept = values[0].as<Pose>();
  std::vector<CondensedFactor::Other> moving;
  std::vector<Eigen::Index> rows;  // of what moves
  Eigen::VectorXd e = Eigen::VectorXd::Zero(all.eta.size());  // of what stays
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < factor.others().size(); ++k) {
    const CondensedFactor::Other& other = factor.others()[k];
    const Eigen::Index size = tangentSize(other.node.layer);
    if (!is_fixed[k + 1]) {
      moving.push_back(other);
      for (Eigen::Index i = 0; i < size; ++i) rows.push_back(row + i);
    } else if (const Plane* plane = std::get_if<Plane>(&other.seen_kept)) {
      e.segment<3>(row) = planeResidual(*plane, tangentBasis(plane->normal), T_map_kept,
                                        values[k + 1].as<Plane>(), nullptr, nullptr);
    } else {
      e.segment<6>(row) = relativePoseResidual(std::get<Pose>(other.seen_kept), T_map_kept,
                                               values[k + 1].as<Pose>(), nullptr, nullptr);
    }
    row += size;
  }
  const Eigen::VectorXd Lambda_e = all.Lambda * e;
  const auto n = static_cast<Eigen::Index>(rows.size());
  CondensedFactor::Quadratic quadratic{Eigen::MatrixXd(n, n), Eigen::VectorXd(n),
                                       all.c + e.dot(Lambda_e - 2.0 * all.eta)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index at = rows[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      quadratic.Lambda(j, i) = all.Lambda(rows[static_cast<std::size_t>(j)], at);
    }
    quadratic.eta(i) = all.eta(at) - Lambda_e(at);
  }
  return {factor.kept(), std::move(moving), std::move(quadratic)};
}

Matrix6 relativeCovariance(const std::vector<FactorConstPtr>& factors, KeyframeId from,
                           KeyframeId to, const LayeredGraph& graph) {
  constexpr double kOpen = 1.0;  // 1/m^2, 1/rad^2
  LocalSystem system(factors, from, {to}, graph);
  // rows: to, from, the others; the one it is seen from stays
  const Eigen::Index others = system.H.rows() - 12;
  Eigen::MatrixXd S = system.H.topLeftCorner<6, 6>();
  if (others > 0) {
    Eigen::MatrixXd H = system.H.bottomRightCorner(others, others);
    H.diagonal().array() += kOpen;
    const Eigen::LLT<Eigen::MatrixXd> llt(H);
    Eigen::MatrixXd Y = system.H.bottomLeftCorner(others, 6);
    llt.matrixL().solveInPlace(Y);
    S.selfadjointView<Eigen::Lower>().rankUpdate(Y.transpose(), -1.0);
  }
  Matrix6 information = S.selfadjointView<Eigen::Lower>();
  information.diagonal().array() += kOpen;
  return information.llt().solve(Matrix6::Identity());
}

}  // namespace mrpt_sgraphs
