// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <ostream>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// graph.graphml: the nodes of the four layers and what ties them together, for tools that look at
/// graphs (networkx, Gephi, yEd). Nodes are `keyframe_12`, `wall_3`, ...
///
/// An edge joins two nodes. A factor of two nodes is one, a factor of one node is a loop at it, and a
/// factor of more is a star of edges from its first node to each other one, which have the number of
/// the factor in common. Factors that compression has shelved are there as well, marked; and
/// doorways and stairs, which are no factors and have no number. docs/file_formats.md lists the data.
void writeGraphMl(const GraphSnapshot& graph, std::ostream& out);

}  // namespace mrpt_sgraphs
