// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mrpt_sgraphs/io/file_error.h"
#include "mrpt_sgraphs/io/graph_file.h"

namespace mrpt_sgraphs {

/// Reads a situational graph whose data association is known, in the text format .sg (quaternions
/// x y z w; planes `n . x = d`, whose normal points out of the room in the file and into it here):
///
///     POSE id floor room visit  x y z qx qy qz qw        floor and room are -1 for none
///     PLANE id  nx ny nz d
///     ROOM id floor  x y  wall wall wall wall            FLOOR id  x y
///     ODOM from to  x y z qx qy qz qw  sigma_m sigma_rad     LOOP likewise
///     OBS keyframe wall  nx ny nz d  sigma_rad sigma_m   in the keyframe's frame
///     ROOMF room sigma_m    FLOORF floor room x y sigma_m    only who belongs to whom
///     GTPOSE, GTPLANE, GTROOM                            the truth, passed over
///
/// Other records are counted and passed over.
/// @throws FileError for what is no number or not finite, a deviation that is not above zero, a
///         quaternion or a normal of length zero, ids twice or not there.
GraphFile readSg(const std::string& path);

/// Writes `POSE id x y z qx qy qz qw` and `PLANE id nx ny nz d` records, 17 digits, the normals out
/// of the room again.
/// @throws std::runtime_error naming the file if it cannot be written.
void writeSgEstimate(const std::string& path, const GraphFile& graph);

}  // namespace mrpt_sgraphs
