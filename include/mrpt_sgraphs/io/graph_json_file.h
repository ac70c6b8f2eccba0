// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/io/file_error.h"
#include "mrpt_sgraphs/io/graph_file.h"

namespace mrpt_sgraphs {

/// Reads keyframes, walls and factors of the graph.json that a run writes; docs/graph.schema.json
/// describes it.
/// @throws FileError naming the place in the document for what is not as the schema has it, not
///         finite, no rotation, not positive semidefinite, there twice or not there, and for a factor
///         of a type that is not known: without it the cost would be another one.
GraphFile readGraphJson(const std::string& path);

/// Writes the document `source` again, with the poses and planes of `graph`.
/// @throws FileError if `source` is not there any more.
/// @throws std::runtime_error naming the file if it cannot be written.
void writeGraphJsonEstimate(const std::string& path, const std::string& source,
                            const GraphFile& graph);

}  // namespace mrpt_sgraphs
