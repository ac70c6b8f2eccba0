// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <mrpt/graphs/CNetworkOfPoses.h>

#include <string>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Nodes with poses in `map`, edges with relative poses and their information on x y z yaw pitch
/// roll (see mrpt_information.h).
using MrptNetwork = mrpt::graphs::CNetworkOfPoses3DInf;

mrpt::poses::CPose3D toMrpt(const Pose& T);
Pose fromMrpt(const mrpt::poses::CPose3D& pose);

/// "edge 3 -> 7": as errors name an edge.
std::string nameOf(const mrpt::graphs::TPairNodeIDs& edge);

/// The first thing that makes the network no graph of poses, in words that name it: a pose that is
/// not finite or not a rigid motion, an edge from a node to itself or to one that is not there, an
/// information that is not finite or not symmetric. Empty if there is none.
///
/// A network of edges alone is one: given its root, MRPT places the other nodes by Dijkstra.
std::string faultOf(const MrptNetwork& network);

}  // namespace mrpt_sgraphs
