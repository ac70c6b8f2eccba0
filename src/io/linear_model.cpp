// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/linear_model.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Cholesky = Eigen::SimplicialLDLT<Sparse>;

constexpr Eigen::Index kColumnsAtATime = 96;  ///< Of right-hand sides: dense, and as long as H.

Eigen::Triplet<double> entry(Eigen::Index row, Eigen::Index column, double value) {
  return {static_cast<int>(row), static_cast<int>(column), value};
}

std::unordered_map<NodeId, VariableView> valuesOf(const GraphSnapshot& graph) {
  std::unordered_map<NodeId, VariableView> values;
  for (const KeyframeNode& node : graph.keyframes) values[node.id] = node.T_map_base;
  for (const WallNode& node : graph.walls) values[node.id] = node.plane_map;
  for (const RoomNode& node : graph.rooms) values[node.id] = node.T_map_room;
  for (const FloorNode& node : graph.floors) values[node.id] = node.ground_map;
  return values;
}

/// Of each node the largest entry of those in metres, and of those in radians.
void useLargestOfEachUnit(const TangentRows& tangents, Eigen::VectorXd* diagonal) {
  for (const NodeId node : tangents.nodes) {
    const Eigen::Index first = tangents.first_row.at(node);
    const Eigen::Index size = tangentSize(node.layer);
    const Eigen::Index of_one_unit = size == 6 ? 3 : 2;  // [t; theta], [a b; d]
    for (auto part : {diagonal->segment(first, of_one_unit),
                      diagonal->segment(first + of_one_unit, size - of_one_unit)}) {
      part.setConstant(std::max(1.0, part.maxCoeff()));
    }
  }
}

/// Of H with a prior on everything.
void factorize(const Sparse& H_lower, const Eigen::VectorXd& scales, Cholesky* cholesky) {
  Sparse prior(H_lower.rows(), H_lower.cols());
  prior.setIdentity();
  prior.diagonal() = kPriorShare * scales;
  cholesky->compute(H_lower + prior);
  if (cholesky->info() != Eigen::Success) {
    throw std::runtime_error("an information is not positive semidefinite");
  }
}

int undeterminedOf(const Cholesky& cholesky, const Eigen::VectorXd& scales) {
  const Eigen::VectorXd pivots = cholesky.permutationPinv() * cholesky.vectorD();
  return static_cast<int>((pivots.array() < kUndeterminedShare * scales.array()).count());
}

}  // namespace

Eigen::Index TangentRows::add(NodeId node) {
  const auto [place, is_new] = first_row.emplace(node, rows);
  if (is_new) {
    nodes.push_back(node);
    rows += tangentSize(node.layer);
  }
  return place->second;
}

LinearModel::LinearModel(const GraphSnapshot& graph, const std::vector<const Factor*>& factors,
                         NodeId fixed) {
  const auto values = valuesOf(graph);
  Triplets triplets;
  std::vector<std::pair<Eigen::Index, double>> gradient;
  for (const Factor* const factor : factors) {
    std::vector<VariableView> views;
    std::vector<Eigen::Index> rows;  // of its tangents; -1: fixed
    for (int k = 0; k < factor->nodeCount(); ++k) {
      const NodeId node = factor->node(k);
      views.push_back(values.at(node));
      const Eigen::Index first = node == fixed ? -1 : tangents_.add(node);
      for (int i = 0; i < tangentSize(node.layer); ++i) rows.push_back(first < 0 ? -1 : first + i);
    }
    const auto size = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd H(size, size);
    Eigen::VectorXd g(size);
    factor->linearize(views.data(), H.data(), g.data());
    for (Eigen::Index column = 0; column < size; ++column) {
      const Eigen::Index j = rows[static_cast<std::size_t>(column)];
      if (j < 0) continue;
      gradient.emplace_back(j, g[column]);
      for (Eigen::Index row = column; row < size; ++row) {
        const Eigen::Index i = rows[static_cast<std::size_t>(row)];
        if (i >= 0) triplets.push_back(entry(std::max(i, j), std::min(i, j), H(row, column)));
      }
    }
  }
  H_.resize(tangents_.rows, tangents_.rows);
  H_.setFromTriplets(triplets.begin(), triplets.end());
  g_ = Eigen::VectorXd::Zero(tangents_.rows);
  for (const auto& [row, value] : gradient) g_[row] += value;
  scales_ = H_.diagonal();
  useLargestOfEachUnit(tangents_, &scales_);
}

MarginalModel LinearModel::marginal(const std::vector<NodeId>& nodes) const {
  MarginalModel result;
  for (const NodeId node : nodes) result.tangents.add(node);
  const Eigen::Index kept = result.tangents.rows;

  // where each row goes: to the marginal from 0 on, or to what is eliminated from `kept` on
  std::vector<Eigen::Index> place(static_cast<std::size_t>(tangents_.rows));
  Eigen::Index next = kept;
  for (const NodeId node : tangents_.nodes) {
    const bool is_kept = result.tangents.contains(node);
    for (Eigen::Index i = 0; i < tangentSize(node.layer); ++i) {
      place[static_cast<std::size_t>(tangents_.first_row.at(node) + i)] =
          is_kept ? result.tangents.first_row.at(node) + i : next++;
    }
  }
  const Eigen::Index eliminated = next - kept;
  result.H = Eigen::MatrixXd::Zero(kept, kept);
  result.g = Eigen::VectorXd::Zero(kept);
  result.scales = Eigen::VectorXd::Ones(kept);
  Eigen::VectorXd g_eliminated(eliminated);
  Eigen::VectorXd scales_eliminated(eliminated);
  Triplets across;
  Triplets within;
  for (Eigen::Index column = 0; column < tangents_.rows; ++column) {
    const Eigen::Index j = place[static_cast<std::size_t>(column)];
    (j < kept ? result.g[j] : g_eliminated[j - kept]) = g_[column];
    (j < kept ? result.scales[j] : scales_eliminated[j - kept]) = scales_[column];
    for (Sparse::InnerIterator it(H_, static_cast<int>(column)); it; ++it) {
      const Eigen::Index i = place[static_cast<std::size_t>(it.row())];
      const Eigen::Index above = std::min(i, j);
      const Eigen::Index below = std::max(i, j);
      if (below < kept) {
        result.H(below, above) = result.H(above, below) = it.value();
      } else if (above < kept) {
        across.push_back(entry(below - kept, above, it.value()));
      } else {
        within.push_back(entry(below - kept, above - kept, it.value()));
      }
    }
  }
  if (eliminated == 0) return result;

  Sparse H_within(eliminated, eliminated);
  H_within.setFromTriplets(within.begin(), within.end());
  Sparse H_across(eliminated, kept);
  H_across.setFromTriplets(across.begin(), across.end());
  Cholesky cholesky;
  factorize(H_within, scales_eliminated, &cholesky);
  result.undetermined = undeterminedOf(cholesky, scales_eliminated);
  const Eigen::VectorXd step = cholesky.solve(g_eliminated);
  result.g -= H_across.transpose() * step;
  for (Eigen::Index first = 0; first < kept; first += kColumnsAtATime) {
    const Eigen::Index count = std::min(kColumnsAtATime, kept - first);
    const Eigen::MatrixXd gain = cholesky.solve(Eigen::MatrixXd(H_across.middleCols(first, count)));
    result.H.middleCols(first, count) -= H_across.transpose() * gain;
  }
  result.H = (0.5 * (result.H + result.H.transpose())).eval();
  return result;
}

std::vector<Matrix6> LinearModel::covariances(const std::vector<KeyframeId>& keyframes) const {
  Cholesky cholesky;
  factorize(H_, scales_, &cholesky);
  std::vector<Matrix6> result;
  Eigen::Matrix<double, Eigen::Dynamic, 6> unit(tangents_.rows, 6);
  for (const KeyframeId keyframe : keyframes) {
    const Eigen::Index row = tangents_.first_row.at(keyframe);
    unit.setZero();
    unit.middleRows<6>(row).setIdentity();
    const Eigen::Matrix<double, Eigen::Dynamic, 6> columns = cholesky.solve(unit);
    const Matrix6 block = columns.middleRows<6>(row);
    result.push_back(0.5 * (block + block.transpose()));
  }
  return result;
}

}  // namespace mrpt_sgraphs
