// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/io/file_error.h"
#include "mrpt_sgraphs/io/graph_file.h"

namespace mrpt_sgraphs {

/// Reads the 3D pose graph of a .g2o file: `VERTEX_SE3:QUAT id x y z qx qy qz qw`,
/// `EDGE_SE3:QUAT from to x y z qx qy qz qw` with the upper triangle of the information row by row,
/// and `FIX id ...`. The cost is g2o's: the rotation's residual is the vector part of the quaternion.
///
/// Vertices and parameters of other types are counted and passed over. An edge of another type is
/// refused: without it the cost would be another one than the file's.
/// @throws FileError for that, for what is no number or not finite, an information that is not
///         positive semidefinite, a quaternion of length zero, ids twice or not there.
GraphFile readG2o(const std::string& path);

/// Writes the estimate as VERTEX_SE3:QUAT records, 17 digits, in the order of the file.
/// @throws std::runtime_error naming the file if it cannot be written.
void writeG2oEstimate(const std::string& path, const GraphFile& graph);

}  // namespace mrpt_sgraphs
