// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "ordering.h"

namespace mrpt_sgraphs {

/// The factor's columns, one for each variable: which later variables fill it.
struct Columns {
  std::vector<std::vector<int>> filled;  ///< Positions above the column's own, ascending.
  std::vector<int> parent;               ///< The first of them; -1 if there is none.
  std::vector<int> size;                 ///< Tangents of the variable.
  std::vector<int> filled_size;          ///< ... of all that fill it.
};

/// The fill of an elimination order.
Columns eliminateColumns(const VariableGraph& graph, const std::vector<int>& order);

/// Operations of eliminating so many pivots from a front, and of all columns each for itself.
double flopsOf(int pivots, int rows);
double flopsOf(const Columns& columns);

/// Which columns are worth eliminating together: for each of them the last one of its group.
std::vector<int> groupColumns(const Columns& columns);

/// The groups, named by their last columns, in postorder; children in the order of their columns.
std::vector<int> postorder(const Columns& columns, const std::vector<int>& group_of);

}  // namespace mrpt_sgraphs
