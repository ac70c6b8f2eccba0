// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "fill_columns.h"

#include <algorithm>
#include <numeric>

namespace mrpt_sgraphs {
namespace {

/// Columns that are eliminated as one front, named by the last of them.
struct Group {
  int pivots = 0;
  double zeros = 0.0;  ///< Entries that are stored though nothing fills them.
};

/// Is a front of so many pivots and rows worth so many zeros? Small ones cost more by being one more
/// front than by their zeros.
bool isWorthMerging(int pivots, int rows, double zeros) {
  const double entries = 0.5 * pivots * (pivots + 1.0) + 1.0 * pivots * rows;
  const double share = zeros / entries;
  if (pivots <= 12) return share < 0.3;
  if (pivots <= 24) return share < 0.15;
  if (pivots <= 48) return share < 0.1;
  return share < 0.05;
}

}  // namespace

Columns eliminateColumns(const VariableGraph& graph, const std::vector<int>& order) {
  const int count = graph.count();
  std::vector<int> position(order.size());
  for (int k = 0; k < count; ++k) position[static_cast<std::size_t>(order[k])] = k;

  Columns columns;
  columns.filled.resize(order.size());
  columns.parent.assign(order.size(), -1);
  columns.size.resize(order.size());
  columns.filled_size.assign(order.size(), 0);
  std::vector<int> seen(order.size(), -1);
  std::vector<std::vector<int>> children(order.size());
  for (int k = 0; k < count; ++k) {
    std::vector<int>& filled = columns.filled[k];
    const auto add = [&](int row) {
      if (row <= k || seen[row] == k) return;
      seen[row] = k;
      filled.push_back(row);
    };
    const int variable = order[k];
    for (int e = graph.first[variable]; e < graph.first[variable + 1]; ++e) {
      add(position[graph.neighbours[e]]);
    }
    for (const int child : children[k]) {
      for (const int row : columns.filled[child]) add(row);
    }
    std::sort(filled.begin(), filled.end());
    columns.size[k] = graph.sizes[variable];
    for (const int row : filled) columns.filled_size[k] += graph.sizes[order[row]];
    if (!filled.empty()) {
      columns.parent[k] = filled.front();
      children[filled.front()].push_back(k);
    }
  }
  return columns;
}

double flopsOf(int pivots, int rows) {
  double flops = 0.0;
  for (int k = 0; k < pivots; ++k) {
    const double below = pivots - k + rows;
    flops += below * below;
  }
  return flops;
}

double flopsOf(const Columns& columns) {
  double flops = 0.0;
  for (std::size_t k = 0; k < columns.size.size(); ++k) {
    flops += flopsOf(columns.size[k], columns.filled_size[k]);
  }
  return flops;
}

std::vector<int> groupColumns(const Columns& columns) {
  const int count = static_cast<int>(columns.size.size());
  std::vector<Group> groups(columns.size.size());
  std::vector<int> merged_into(columns.size.size());
  std::iota(merged_into.begin(), merged_into.end(), 0);
  std::vector<std::vector<int>> children(columns.size.size());
  for (int k = 0; k < count; ++k) {
    Group& group = groups[k];
    group.pivots = columns.size[k];
    // those that fill most of it first
    std::sort(children[k].begin(), children[k].end(), [&](int a, int b) {
      return columns.filled_size[a] != columns.filled_size[b]
                 ? columns.filled_size[a] > columns.filled_size[b]
                 : a < b;
    });
    for (const int child : children[k]) {
      const Group& other = groups[child];
      const double new_zeros = static_cast<double>(other.pivots) *
                               (group.pivots + columns.filled_size[k] - columns.filled_size[child]);
      const int pivots = group.pivots + other.pivots;
      const double zeros = group.zeros + other.zeros + new_zeros;
      if (new_zeros > 0.0 && !isWorthMerging(pivots, columns.filled_size[k], zeros)) continue;
      group = {pivots, zeros};
      merged_into[child] = k;
    }
    if (columns.parent[k] >= 0) children[columns.parent[k]].push_back(k);
  }
  for (int k = count - 1; k >= 0; --k) merged_into[k] = merged_into[merged_into[k]];
  return merged_into;
}

std::vector<int> postorder(const Columns& columns, const std::vector<int>& group_of) {
  const int count = static_cast<int>(group_of.size());
  std::vector<int> first_child(group_of.size(), -1);
  std::vector<int> next_sibling(group_of.size(), -1);
  int first_root = -1;
  for (int k = count - 1; k >= 0; --k) {
    if (group_of[k] != k) continue;
    const int parent = columns.parent[k] < 0 ? -1 : group_of[columns.parent[k]];
    int& first = parent < 0 ? first_root : first_child[parent];
    next_sibling[k] = first;
    first = k;
  }
  std::vector<int> result;
  std::vector<int> stack;
  for (int root = first_root; root >= 0; root = next_sibling[root]) {
    stack.push_back(root);
    while (!stack.empty()) {
      const int group = stack.back();
      if (first_child[group] >= 0) {  // its children first, each of them once
        const int child = first_child[group];
        first_child[group] = next_sibling[child];
        stack.push_back(child);
      } else {
        stack.pop_back();
        result.push_back(group);
      }
    }
  }
  return result;
}

}  // namespace mrpt_sgraphs
