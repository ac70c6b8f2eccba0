// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <map>
#include <memory>
#include <vector>

#include "support/factor_laws.h"

namespace mrpt_sgraphs::test {

/// Any factors and their nodes in one dense matrix: slow, and plain enough to be right.
struct DenseProblem {
  std::map<NodeId, Value> values;
  std::vector<FactorConstPtr> factors;

  Eigen::Index rowOf(NodeId node) const {
    Eigen::Index row = 0;
    for (auto it = values.begin(); it->first != node; ++it) row += tangentSize(it->first.layer);
    return row;
  }
  std::vector<Eigen::Index> rowsOf(const std::vector<NodeId>& nodes) const {
    std::vector<Eigen::Index> rows;
    for (const NodeId node : nodes) {
      for (int k = 0; k < tangentSize(node.layer); ++k) rows.push_back(rowOf(node) + k);
    }
    return rows;
  }
  Values valuesOf(const Factor& factor) const {
    Values result;
    for (int k = 0; k < factor.nodeCount(); ++k) result.push_back(values.at(factor.node(k)));
    return result;
  }

  /// cost + 2 g' delta + delta' H delta, rows in node order.
  Linearized linearize() const {
    Eigen::Index rows = 0;
    for (const auto& [node, value] : values) rows += tangentSize(node.layer);
    Linearized sum{0.0, Eigen::MatrixXd::Zero(rows, rows), Eigen::VectorXd::Zero(rows)};
    for (const FactorConstPtr& factor : factors) {
      const Linearized one = test::linearize(*factor, valuesOf(*factor));
      std::vector<NodeId> nodes;
      for (int k = 0; k < factor->nodeCount(); ++k) nodes.push_back(factor->node(k));
      const std::vector<Eigen::Index> places = rowsOf(nodes);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        sum.g(places[i]) += one.g(row);
        for (std::size_t j = 0; j < places.size(); ++j) {
          sum.H(places[i], places[j]) += one.H(row, static_cast<Eigen::Index>(j));
        }
      }
      sum.cost += one.cost;
    }
    return sum;
  }

  /// Full Gauss-Newton steps until they are nothing.
  void minimize() {
    for (int iteration = 0; iteration < 50; ++iteration) {
      const Linearized model = linearize();
      const Eigen::VectorXd delta =
          -model.H.completeOrthogonalDecomposition().solve(model.g).eval();
      for (auto& [node, value] : values) {
        value = retracted(Values{value}, delta.segment(rowOf(node), tangentSize(node.layer)))[0];
      }
      if (delta.norm() < 1e-12) break;
    }
  }
};

inline Eigen::MatrixXd pick(const Eigen::MatrixXd& M, const std::vector<Eigen::Index>& rows,
                            const std::vector<Eigen::Index>& columns) {
  Eigen::MatrixXd result(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = M(rows[i], columns[j]);
    }
  }
  return result;
}

/// What remains on the kept rows when the others are minimized over.
inline Linearized schurComplement(const Linearized& model, const std::vector<Eigen::Index>& kept,
                                  const std::vector<Eigen::Index>& eliminated) {
  const auto inverse = pick(model.H, eliminated, eliminated).completeOrthogonalDecomposition();
  const Eigen::MatrixXd across = pick(model.H, kept, eliminated);
  const Eigen::VectorXd g_eliminated = pick(model.g, eliminated, {0});
  const Eigen::MatrixXd gain = inverse.solve(across.transpose()).transpose();
  return {model.cost - g_eliminated.dot(inverse.solve(g_eliminated)),
          pick(model.H, kept, kept) - gain * across.transpose(),
          pick(model.g, kept, {0}) - gain * g_eliminated};
}

/// The rank of a symmetric matrix, against the scale of `reference`.
inline int rankOf(const Eigen::MatrixXd& M, double reference) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array().abs() > 1e-9 * reference).count());
}

}  // namespace mrpt_sgraphs::test
