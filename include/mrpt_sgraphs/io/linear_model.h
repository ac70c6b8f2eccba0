// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/SparseCore>
#include <unordered_map>
#include <vector>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// Where the tangents of nodes are in a vector of all of them.
struct TangentRows {
  std::vector<NodeId> nodes;  ///< In the order of their rows.
  std::unordered_map<NodeId, Eigen::Index> first_row;
  Eigen::Index rows = 0;

  /// The node's first row; it gets the next ones if it has none.
  Eigen::Index add(NodeId node);
  bool contains(NodeId node) const { return first_row.count(node) != 0; }
};

/// Eigenvalues of an information that are less than this share of what its factors add to the
/// diagonal are beyond what doubles tell from zero. So much is added: by a prior of that strength a
/// singular information is a Gaussian, and one of 2000 keyframes in a row is still itself.
constexpr double kPriorShare = 1e-11;

/// A pivot with less than this share of its diagonal left is that of a direction which nothing but
/// the prior determines.
constexpr double kUndeterminedShare = 1e-9;

/// What factors say about some nodes, all others minimized over: delta' H delta + 2 g' delta + c.
struct MarginalModel {
  TangentRows tangents;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  /// What kPriorShare is relative to: the diagonal before anything was minimized over, the largest
  /// of a node's entries in one unit, and at least 1.
  Eigen::VectorXd scales;
  int undetermined = 0;  ///< Directions among what was minimized over.
};

/// Factors linearized where their nodes are, as a solver sees them: information H = sum J' Omega J,
/// gradient g = sum J' Omega e, robust weights included. One node is fixed.
class LinearModel {
 public:
  /// @param factors  Between nodes of `graph`, of which only the values are used.
  LinearModel(const GraphSnapshot& graph, const std::vector<const Factor*>& factors, NodeId fixed);

  /// The nodes of the factors, but for the fixed one.
  const TangentRows& tangents() const { return tangents_; }

  /// Exact, by a Schur complement. A node that no factor touches has rows of zeros.
  MarginalModel marginal(const std::vector<NodeId>& nodes) const;

  /// The marginal covariance of the tangents of each of these keyframes.
  /// @throws std::out_of_range for one that no factor touches.
  std::vector<Matrix6> covariances(const std::vector<KeyframeId>& keyframes) const;

 private:
  TangentRows tangents_;
  Eigen::SparseMatrix<double> H_;  ///< Its lower triangle.
  Eigen::VectorXd g_;
  Eigen::VectorXd scales_;
};

}  // namespace mrpt_sgraphs
