// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/wall_points.h"

namespace mrpt_sgraphs {

/// Binary PLY files: x y z and, with or without colours, red green blue or intensity.
void writePly(const Cloud& cloud, std::ostream& out);
void writePly(const ColouredCloud& cloud, std::ostream& out);

/// A binary PCD file with the fields x y z rgb.
void writePcd(const ColouredCloud& cloud, std::ostream& out);

/// Which points of a map are written.
struct MapFileRequest {
  std::string path;           ///< Ends in .pcd or .ply.
  double resolution_m = 0.0;  ///< One point a voxel; 0: every point.
  std::string floor;          ///< Name or id; empty: all floors.
  bool colour_by_room = false;
};

/// The file is the old one or the new one, whatever happens.
/// @return How many points were written.
/// @throws std::invalid_argument saying what is wrong with the request: an ending that is none of
///         the two, a resolution below 0, a floor that there is not, and if there is no point.
/// @throws std::runtime_error naming the file and the reason if it cannot be written.
std::size_t writeMapCloud(const GraphSnapshot& graph, const MapFileRequest& request);

}  // namespace mrpt_sgraphs
