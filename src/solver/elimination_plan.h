// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <vector>

#include "ordering.h"

namespace mrpt_sgraphs {

/// Rows of a child that lie side by side in its parent too.
struct RowRun {
  int child_row = 0;   ///< Row of the child's update.
  int parent_row = 0;  ///< Row of the parent's front.
  int size = 0;
};

/// A few variables that are eliminated together, and the rows that this fills. Everything here counts
/// tangents (scalars) but for `first_variable` and `variables`.
struct Front {
  int first_variable = 0;  ///< In EliminationPlan::order; its pivots follow each other there.
  int variables = 0;
  int first_pivot = 0;  ///< In the ordered vector of all tangents.
  int pivots = 0;
  int rows = 0;
  int first_row = 0;  ///< In EliminationPlan::rows: the tangent of each row.
  int parent = -1;
  int first_child = 0;  ///< In EliminationPlan::children.
  int children = 0;
  int first_run = 0;  ///< In EliminationPlan::runs: where its update goes in the parent.
  int runs = 0;
  int depth = 0;  ///< Below its root.
  std::size_t panel = 0;   ///< Where it begins in the memory of all panels.
  std::size_t update = 0;  ///< ... in the memory of updates.
};

/// The symbolic factorization: in which order the variables are eliminated, in which fronts, and
/// where everything lies. Fronts come in postorder: children before their parent, and a subtree
/// without a gap.
struct EliminationPlan {
  std::vector<int> order;       ///< The variable that comes k-th.
  std::vector<int> position;    ///< Where a variable comes.
  std::vector<int> tangent;     ///< The first tangent of the k-th variable, and behind the last.
  std::vector<Front> fronts;
  std::vector<int> front_of;    ///< The front that eliminates the k-th variable.
  std::vector<int> rows;        ///< See Front.
  std::vector<int> children;
  std::vector<RowRun> runs;
  /// Subtrees [first, last) that different threads may take, and the fronts above them.
  struct Subtree {
    int first = 0;
    int last = 0;
  };
  std::vector<Subtree> subtrees;
  std::vector<int> top;
  std::size_t panel_memory = 0;   ///< doubles
  std::size_t update_memory = 0;  ///< doubles
  double flops = 0.0;
  bool nested_dissection = false;
};

/// The order with fewer operations of minimum degree and, where the fill is large, nested dissection.
EliminationPlan planElimination(const VariableGraph& graph);

}  // namespace mrpt_sgraphs
