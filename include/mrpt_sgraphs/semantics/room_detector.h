// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>

#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/room_detector_config.h"

namespace mrpt_sgraphs {

/// Finds the rooms of every floor: the free space that the keyframes' rays have crossed, cut at
/// doors and narrow passages, and the walls that bound each part. A room is what the robot was in.
class RoomDetector {
 public:
  explicit RoomDetector(const RoomDetectorConfig& config);
  ~RoomDetector();

  /// Takes what is new or has moved since the last call into the free space, and looks for rooms.
  /// @param graph  Its keyframes need their floors, and those whose rays are to count their clouds:
  ///               one whose cloud was let go of is still in its room.
  RoomDetection detect(const GraphSnapshot& graph);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a);

 private:
  struct State;  ///< Not in the header: OctoMap and OpenCV.

  std::unique_ptr<State> state_;
};

}  // namespace mrpt_sgraphs
