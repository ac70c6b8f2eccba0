// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

namespace mrpt_sgraphs {

/// Which variables share a factor: what the pattern of the normal equations comes from.
struct VariableGraph {
  std::vector<int> sizes;       ///< Tangents of each variable.
  std::vector<int> first;       ///< Of each variable's neighbours, one more than there are variables.
  std::vector<int> neighbours;  ///< Each pair in both directions, once; no variable is its own.

  int count() const { return static_cast<int>(sizes.size()); }
};

/// Elimination orders: the variable that comes k-th. Minimum degree (AMD) is the better one for
/// graphs of tiny fronts, nested dissection (METIS) where the fill is large.
/// @throws std::runtime_error if the library refuses or has no memory.
std::vector<int> minimumDegreeOrder(const VariableGraph& graph);
std::vector<int> nestedDissectionOrder(const VariableGraph& graph);

}  // namespace mrpt_sgraphs
