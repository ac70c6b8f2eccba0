// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mrpt_sgraphs/geometry/keyframe_runs.h"

namespace mrpt_sgraphs {

/// What one optimization did, a row of optimizations.csv.
struct OptimizationSummary {
  double stamp_s = 0.0;   ///< Of the newest keyframe in it.
  /// local | room_local | floor_local | global | full, and what comes with them: condense (keyframes
  /// are dropped), resolve (dropped keyframes are found again).
  std::string kind;
  std::string mode;            ///< baseline | paper | condensed
  std::optional<RoomId> room;  ///< Of room_local, and of condense where it is in a room.
  int keyframes_active = 0;
  int keyframes_marginalized = 0;
  int dropped = 0;  ///< Of these, by this condense.
  int walls = 0;
  int rooms = 0;
  int floors = 0;
  int factors = 0;
  int free_variables = 0;
  KeyframeRuns free_keyframes;   ///< Whose poses were variables.
  KeyframeRuns fixed_keyframes;  ///< That took part and stayed where they were.
  int iterations = 0;
  double cost_before = 0.0;  ///< Sum of the weighted squared residuals, robust kernels applied.
  double cost_after = 0.0;
  bool converged = false;
  std::string problem;        ///< Why not, in one sentence; empty if it converged.
  double total_ms = 0.0;      ///< CPU
  double linearize_ms = 0.0;  ///< CPU
  double factorize_ms = 0.0;  ///< CPU
};

}  // namespace mrpt_sgraphs
