// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "mrpt_sgraphs/graph/mrpt_network.h"

/// MRPT's own file formats of a network of poses, without what is lost on MRPT's ways to them: its
/// text writer has six digits, its text reader drops the information between the angles and, unless
/// told not to, all but one of parallel edges. MRPT reads our files, and we read its.
namespace mrpt_sgraphs {

/// What was in a text file.
struct MrptTextFile {
  MrptNetwork network;
  std::set<mrpt::graphs::TNodeID> fixed;           ///< All that FIX lines name.
  std::size_t edges_without_information = 0;       ///< They have got the identity, as MRPT does it.
  std::map<std::string, std::size_t> passed_over;  ///< Unknown records, and how many of each.
};

/// Reads VERTEX3, VERTEX_SE3:QUAT, EDGE3, EDGE_SE3:QUAT, EQUIV and FIX lines; comments begin with
/// #, % or //. Numbers mean what they mean to MRPT: the informations of both kinds of edges are
/// those of a CPose3DPDFGaussianInf, their rows and columns in the order x y z roll pitch yaw.
/// Parallel edges stay, in the order of the file. Without FIX the root is node 0, or the first if
/// there is no 0.
///
/// @throws std::runtime_error naming the file, the line and the reason, for a line that is not what
///         its first word says, a number that is not finite, a quaternion without a direction, a
///         node twice, an edge to a node that is not in the file (unless none is) or to itself, and
///         a record of a graph in the plane.
MrptTextFile readMrptText(const std::string& path);

/// Writes VERTEX3 and EDGE3 lines as MRPT does, with all 17 digits: positions and informations come
/// back as they were, rotations to rounding error also where yaw and roll turn about one axis.
///
/// @throws std::invalid_argument with the network's fault (see faultOf), or if its edges store
///         inverse poses, which the format cannot say.
/// @throws std::runtime_error naming the file that could not be written.
void writeMrptText(const std::string& path, const MrptNetwork& network);

/// Reads what MRPT's `archive << network` wrote.
/// @throws std::runtime_error naming the file and the reason if it is anything else, damaged or not
///         a graph of poses (see faultOf).
MrptNetwork readMrptBinary(const std::string& path);

/// Writes MRPT's binary serialization, exact to the last bit.
/// @throws as writeMrptText
void writeMrptBinary(const std::string& path, const MrptNetwork& network);

}  // namespace mrpt_sgraphs
