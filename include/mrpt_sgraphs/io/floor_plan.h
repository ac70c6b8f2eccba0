// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <ostream>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// A plan of one storey as SVG, for any browser: rooms filled, with their names and areas, walls as
/// thick as they were measured, doors, stairs and a scale bar. x of the map points to the right and
/// y up.
///
/// The walls are what stands between half a metre and 1.8 m above the ground, so doors are open in
/// them. A wall of which only one face was seen is drawn lighter, with a thickness that nobody has
/// measured.
/// @param floor  None: what belongs to no floor, where floors are not looked for.
void writeFloorPlan(const GraphSnapshot& graph, std::optional<FloorId> floor, std::ostream& out);

}  // namespace mrpt_sgraphs
