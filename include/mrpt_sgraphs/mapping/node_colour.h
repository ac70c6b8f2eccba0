// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

#include "mrpt_sgraphs/geometry/ids.h"

namespace mrpt_sgraphs {

/// Red, green and blue from 0 to 1, the same for a wall or a room for ever. The hue goes round by
/// the golden ratio, so that those that were found one after the other look different.
Eigen::Vector3f colourOf(NodeId node);

}  // namespace mrpt_sgraphs
