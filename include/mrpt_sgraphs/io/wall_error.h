// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/graph/nodes.h"
#include "mrpt_sgraphs/io/building_file.h"

namespace mrpt_sgraphs {

/// When a wall that was found is one that is there, and when a wall that is there had to be found.
struct WallMatching {
  double max_angle_rad = 0.0873;  ///< Between the normals: 5 degrees. The other side is 180.
  double max_offset_m = 0.15;     ///< Along the normal, at the middle of what was found.
  double margin_m = 0.2;          ///< By which the true wall is grown on all sides,
  double min_share = 0.5;         ///< to hold at least this part of the found polygon.
  double min_seen_m2 = 2.0;       ///< Of a true wall, or it need not be found.
  double max_gap_m = 1.5;         ///< Between parts of one wall.
};

/// How well the walls of a run are those of the building.
///
/// Faces of a building that lie in one plane, look to the same side and are no more than max_gap_m
/// apart (two offices along one facade) are one surface: no sensor can tell whether it is one wall
/// or two, and a run may find either. A found wall is right if it lies on one such surface within
/// the limits of WallMatching; what is right belongs to the surface that holds most of it, then to
/// the one least off. A true face is found when right walls of its surface cover it: one of them
/// has half of its area within the margin of it, or min_seen_m2 / 2 on it.
struct WallErrors {
  struct Spread {
    double median = 0.0;
    double p90 = 0.0;
  };

  std::size_t found = 0;         ///< Walls of the run.
  std::size_t right = 0;         ///< Those of them that are there.
  bool seen_is_known = false;    ///< Else nobody can say what had to be found.
  std::size_t true_walls = 0;    ///< Faces that had to be found.
  std::size_t found_true = 0;    ///< Those of them that were.
  std::size_t duplicates = 0;    ///< Faces covered twice or more, by walls no farther apart along
                                 ///< them than max_gap_m.
  Spread normal_deg;             ///< Of the right ones, against the true plane,
  Spread offset_m;               ///< and at the middle of what was found; NaN without any.
  std::vector<uint64_t> missed;  ///< Faces of the building.
  std::vector<uint64_t> wrong;   ///< Walls of the run.
  std::vector<uint64_t> twice;   ///< Faces of the building.

  double precision() const;  ///< NaN if nothing was found.
  double recall() const;     ///< NaN if nobody can say.
};

/// @param truth  Faces without a plane are passed over.
WallErrors evaluateWalls(const std::vector<TrueWall>& truth, const std::vector<WallNode>& found,
                         const Pose& T_truth_map, const WallMatching& matching = {});

}  // namespace mrpt_sgraphs
