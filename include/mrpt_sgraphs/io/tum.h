// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// A line of a TUM trajectory file.
struct StampedPose {
  double stamp_s = 0.0;
  Pose T_world_body = Pose::Identity();
};

using Trajectory = std::vector<StampedPose>;

/// Reads `t x y z qx qy qz qw` lines; empty lines and lines that begin with # are passed over.
/// @throws std::runtime_error naming the file, and the line for one that is not eight finite numbers.
Trajectory readTum(const std::string& path);

/// Writes stamps to the microsecond and poses to the nanometre.
/// @throws std::runtime_error naming the file that could not be written.
void writeTum(const std::string& path, const Trajectory& trajectory);

}  // namespace mrpt_sgraphs
