// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <istream>
#include <string>

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// Reads what writeGraphJson wrote, versions 1 and 2. Written again, it is the same to the last
/// digit. What the file does not have is left out: the keyframes' clouds, the numbers of factors.
/// Heights, holes, doorways, stairs, the walls' floors, shelved factors and the ways of condensed
/// ones came in the course of version 2: without them a file is read as one that knows of none.
///
/// @param name  What the file is called in errors.
/// @throws std::runtime_error that says where in the file what is wrong, for anything else: no
///         JSON, another version, a field that is missing or of the wrong type, a node that is not
///         there.
LayeredGraph readGraphJson(std::istream& in, const std::string& name = "graph.json");

}  // namespace mrpt_sgraphs
