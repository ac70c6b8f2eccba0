// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/io/file_error.h"
#include "mrpt_sgraphs/io/graph_file.h"

namespace mrpt_sgraphs {

/// The formats of graphs, by the end of the file's name.
enum class GraphFormat { kG2o, kSg, kJson };

/// @throws FileError if the name ends in none of .g2o, .sg and .json.
GraphFormat graphFormatOf(const std::string& path);

/// @throws FileError, see the readers.
GraphFile readGraphFile(const std::string& path);

/// Writes the estimate in the format of the file that the graph was read from, `source`.
/// @throws std::runtime_error naming the file if it cannot be written.
void writeEstimate(const std::string& path, const std::string& source, const GraphFile& graph);

}  // namespace mrpt_sgraphs
