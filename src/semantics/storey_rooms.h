// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/archive_graph.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/mapping/free_space.h"
#include "mrpt_sgraphs/mapping/placed_clouds.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/room_detector_config.h"

namespace mrpt_sgraphs {

/// The rooms of one storey.
class StoreyRooms {
 public:
  StoreyRooms(const RoomDetectorConfig& config, std::optional<FloorId> floor)
      : config_(config),
        floor_(floor),
        space_(config.free_space),
        placed_(kTolerance * config.free_space.cell_m) {}

  /// Takes into the free space what is new or has moved, and out of it what is gone: keyframes, or
  /// their clouds.
  /// @param T_floor_map  z is up, and zero on the ground.
  /// @return Whether anything was, or had.
  bool integrate(const std::vector<const KeyframeNode*>& keyframes, const Pose& T_floor_map);

  /// @param passing  Keyframes on stairs and ramps: a region with half as many of them as of the
  ///                 storey's own is a stairwell.
  std::vector<DetectedRoom> detect(const std::vector<const KeyframeNode*>& keyframes,
                                   const std::vector<const KeyframeNode*>& passing,
                                   const SharedVector<WallNode>& walls,
                                   const Pose& T_floor_map) const;

  const FreeSpace& space() const { return space_; }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    CellBox known = space_.box();
    a("known", known);
    a("placed", placed_);
    if constexpr (Archive::kReads) {
      // sums are exact: what is added again is what was there
      placed_.forEach([this](const Cloud& cloud, const Pose& T_floor_base) {
        space_.add(cloud, T_floor_base);
      });
      space_.extendBox(known);
    }
  }

 private:
  static constexpr double kTolerance = 0.5;  ///< Of a cell.

  RoomDetectorConfig config_;
  std::optional<FloorId> floor_;
  FreeSpace space_;
  PlacedClouds placed_;
};

}  // namespace mrpt_sgraphs
