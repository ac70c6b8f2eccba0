// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <ostream>
#include <string>
#include <vector>

#include "mrpt_sgraphs/mapping/floor_grid.h"

namespace mrpt_sgraphs {

/// A grid as an image that map_server reads: P5, north up; black is occupied, white free, grey
/// unknown.
void writePgm(const FloorGrid& grid, std::ostream& out);

/// What map_server wants to know of it.
/// @param image  Name of that file, beside this one.
void writeGridYaml(const FloorGrid& grid, const std::string& image, std::ostream& out);

/// Into a folder that is there: map.bt, and floor_<id>.pgm and .yaml of every floor.
/// @param graph  With the clouds of its keyframes.
/// @throws std::runtime_error naming the file and the reason.
void writeMapFiles(const std::string& folder, const GraphSnapshot& graph, const MapConfig& config);

/// A grid from its .yaml, by the rules of map_server (`mode: trinary`): its floor and ground are not
/// told there.
/// @throws std::runtime_error naming the file and what is wrong with it.
FloorGrid readGrid(const std::string& yaml_path);

/// The centres of the occupied cells of a .bt file, each as large as the smallest.
/// @throws std::runtime_error naming the file and what is wrong with it.
std::vector<Eigen::Vector3f> readOccupiedCells(const std::string& path);

}  // namespace mrpt_sgraphs
