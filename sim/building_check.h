// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/building.h"

/// The rules of a building file. Each throws std::invalid_argument naming the place in the file.
namespace mrpt_sgraphs::sim {

/// Storeys lie above each other; outlines are simple, counter-clockwise and apart; names are
/// unique.
void checkRooms(const Building& building);

/// Finds the wall faces that doors and windows pierce: of every room near the point the nearest
/// face; a door needs two rooms with parallel faces, a window one.
void resolveOpenings(Building& building);

/// Furniture, pillars, people and stairs are inside rooms and fit.
void checkContents(const Building& building);

}  // namespace mrpt_sgraphs::sim
