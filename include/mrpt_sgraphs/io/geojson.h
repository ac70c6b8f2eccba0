// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <ostream>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// rooms.geojson: rooms as polygons and the ways between them as lines, in the structure of RFC
/// 7946. Coordinates are metres of the map frame and no longitudes and latitudes; the member
/// `coordinates_of` says so. docs/file_formats.md lists the properties.
void writeGeoJson(const GraphSnapshot& graph, std::ostream& out);

}  // namespace mrpt_sgraphs
