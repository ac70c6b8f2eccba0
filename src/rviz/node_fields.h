// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "shown_graph.h"

namespace mrpt_sgraphs {

/// What a graph says of a node, to be read: the name of each field and its value with its unit.
using NodeFields = std::vector<std::pair<std::string, std::string>>;

/// Empty for a node that is not in the graph.
NodeFields fieldsOf(const ShownGraph& graph, NodeId node);

}  // namespace mrpt_sgraphs
