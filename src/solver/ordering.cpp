// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ordering.h"

#include <amd.h>
#include <metis.h>

#include <numeric>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {
namespace {

/// Variables that know nothing of each other: any order will do, and neither library takes them.
std::vector<int> asTheyCome(const VariableGraph& graph) {
  std::vector<int> order(graph.sizes.size());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace

std::vector<int> minimumDegreeOrder(const VariableGraph& graph) {
  if (graph.neighbours.empty()) return asTheyCome(graph);
  std::vector<int> order(graph.sizes.size());
  const int status = amd_order(graph.count(), graph.first.data(), graph.neighbours.data(),
                               order.data(), nullptr, nullptr);
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED) {
    throw std::runtime_error("AMD could not order " + std::to_string(graph.count()) +
                             " variables, status " + std::to_string(status));
  }
  return order;
}

std::vector<int> nestedDissectionOrder(const VariableGraph& graph) {
  if (graph.neighbours.empty()) return asTheyCome(graph);
  idx_t count = graph.count();
  std::vector<idx_t> first(graph.first.begin(), graph.first.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> weights(graph.sizes.begin(), graph.sizes.end());
  std::vector<idx_t> order(graph.sizes.size());
  std::vector<idx_t> inverse(graph.sizes.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status = METIS_NodeND(&count, first.data(), neighbours.data(), weights.data(), options,
                                  order.data(), inverse.data());
  if (status != METIS_OK) {
    throw std::runtime_error("METIS could not order " + std::to_string(graph.count()) +
                             " variables, status " + std::to_string(status));
  }
  return std::vector<int>(order.begin(), order.end());
}

}  // namespace mrpt_sgraphs
