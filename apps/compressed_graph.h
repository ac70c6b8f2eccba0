// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "optimizable_graph.h"

namespace mrpt_sgraphs {

/// A .sg file or a graph.json, to be optimized by the hierarchy of mode `paper` or `condensed`.
/// @throws std::runtime_error naming the file and what is wrong with it.
std::unique_ptr<OptimizableGraph> readCompressedGraph(const std::string& path,
                                                      const std::string& mode);

}  // namespace mrpt_sgraphs
