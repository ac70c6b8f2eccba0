// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <ostream>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// graph.json: versioned and lossless; docs/graph.schema.json describes it, readGraphJson reads it.
void writeGraphJson(const GraphSnapshot& graph, std::ostream& out);

/// The pose layer in the g2o text format (VERTEX_SE3:QUAT, EDGE_SE3:QUAT, FIX), 17 digits. g2o's
/// residual is (t, vector part of the quaternion), which is half the rotation vector: the rotational
/// rows and columns of the information are doubled to mean the same.
///
/// What condensed factors say is written as relative poses from the kept keyframe to each other one,
/// by the marginals of their quadratics; a dropped keyframe hangs on the one that it moves with. So
/// the file is connected where the graph is, and a tool that knows poses alone can use it.
void writeG2o(const GraphSnapshot& graph, std::ostream& out);

/// A binary PCD file with the fields x y z intensity.
void writePcd(const Cloud& cloud, std::ostream& out);

}  // namespace mrpt_sgraphs
