// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/simulation.h"

/// The true answers to a run, as text. All in the map frame.
namespace mrpt_sgraphs::sim {

/// `t x y z qx qy qz qw` at the header stamp of every scan.
std::string lidarTrajectoryTum(const Simulation& simulation);
std::string baseTrajectoryTum(const Simulation& simulation);

/// Version 1 of building.json: floors, rooms, walls and doors.
///
/// A wall is one face: `normal` points into its room, normal . p = `distance` on it, `polygon` is
/// its outer extent and `holes` its doors and windows, `seen_m2` the part of it that the run so far
/// has seen from near, in whole cells (SeenWalls). A room is `entered` if the base was inside
/// its outline at the stamp of a scan.
std::string buildingJson(const Simulation& simulation);

/// Writes truth/{trajectory.tum, base_trajectory.tum, building.json} below `directory`, each
/// complete or not at all.
/// @throws std::runtime_error naming the file that cannot be written.
void writeTruth(const Simulation& simulation, const std::string& directory);

}  // namespace mrpt_sgraphs::sim
