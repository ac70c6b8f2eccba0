// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/graph/nodes.h"
#include "mrpt_sgraphs/io/building_file.h"
#include "mrpt_sgraphs/io/tum.h"

namespace mrpt_sgraphs {

/// When a room that was found is one that is there.
struct RoomMatching {
  double min_iou = 0.5;       ///< Intersection over union of the two as seen from above.
  double min_share = 0.5;     ///< Of its area, for one room to lie in another.
  std::size_t min_scans = 5;  ///< In a room that is not listed, for the robot to have entered it.
};

/// How well the rooms of a run are those of the building.
///
/// Rooms of one storey are compared as seen from above, holes taken out. Found and true rooms are
/// matched one to one, those with the greatest intersection over union first.
///
/// True rooms that the robot did not enter and stairwells count neither way: a found room that lies
/// in one of them more than in any other is left out. Where not all rooms are listed, what was
/// found beside the listed ones is left out too if the robot was not in it.
struct RoomErrors {
  struct Match {
    uint64_t truth = 0;
    uint64_t found = 0;
    double iou = 0.0;
  };

  std::size_t found = 0;                  ///< Rooms of the run, without those left out.
  std::size_t true_rooms = 0;             ///< That had to be found.
  std::vector<Match> matches;             ///< In the order of the true rooms.
  double mean_iou = 0.0;                  ///< Over all true rooms, 0 for those missed;
  double mean_iou_of_matched = 0.0;       ///< over those found alone. NaN without any.
  std::vector<uint64_t> missed;           ///< Rooms of the building.
  std::vector<uint64_t> wrong;            ///< Rooms of the run.
  std::vector<uint64_t> not_listed;       ///< Those of `wrong` that lie beside all rooms of a list
                                          ///< that need not be complete.
  std::vector<uint64_t> left_out;         ///< Rooms of the run.
  std::vector<uint64_t> over_segmented;   ///< True rooms in which two found ones lie, or more.
  std::vector<uint64_t> under_segmented;  ///< Found rooms in which two true ones lie, or more.
  std::size_t corridors = 0;              ///< Of the true rooms;
  std::size_t whole_corridors = 0;        ///< those of them that were found as one room.

  double precision() const;  ///< NaN if nothing was found.
  double recall() const;     ///< NaN if nothing had to be found.
};

/// @param truth_trajectory  In the truth's frame: tells in which rooms the robot was, where rooms
///                          are not listed.
/// @throws std::length_error for a room that is kilometres wide, or farther away than the earth is large.
RoomErrors evaluateRooms(const TrueBuilding& truth, const std::vector<RoomNode>& found,
                         const Pose& T_truth_map, const Trajectory& truth_trajectory,
                         const RoomMatching& matching = {});

}  // namespace mrpt_sgraphs
