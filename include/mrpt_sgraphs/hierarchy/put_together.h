// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// Puts condensed regions together: from the first keyframe on, each node goes to where the first
/// relative pose or condensed factor that reaches it has it, breadth first, so that errors add up
/// over as few of them as there can be. What none reaches stays.
void putTogether(LayeredGraph* graph);

}  // namespace mrpt_sgraphs
