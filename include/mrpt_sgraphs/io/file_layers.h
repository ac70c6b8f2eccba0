// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/io/graph_file.h"

namespace mrpt_sgraphs {

/// The layers of a file's graph, all with the ids of the file. What a .sg file does not say: a room
/// lies on its floor and heads where its first wall looks to; a floor is level and as low as the
/// lowest keyframe on it. Neither takes part in an optimization, as no factor of a file says
/// anything about them.
/// @throws std::invalid_argument for what LayeredGraph refuses.
LayeredGraph layersOf(const GraphFile& file);

}  // namespace mrpt_sgraphs
