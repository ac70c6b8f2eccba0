// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/mapping/free_space_config.h"

namespace mrpt_sgraphs {

/// What is a room.
struct RoomDetectorConfig {
  bool enabled = true;
  FreeSpaceConfig free_space;
  double max_door_m = 1.5;  ///< What is open between a wall's end and another wall across its way
  double max_passage_m =
      2.5;                   ///< or between two walls in one line parts two rooms up to this width.
  double min_area_m2 = 2.0;  ///< What is smaller is no room,
  double min_bounded = 0.5;  ///< nor what has walls on a smaller share of its outline: outdoors.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("enabled", self.enabled);
    FreeSpaceConfig::fields(self.free_space, field);
    field("max_door_m", self.max_door_m, 0.5, 10.0);
    field("max_passage_m", self.max_passage_m, 0.5, 10.0);
    field("min_area_m2", self.min_area_m2, 0.1, 1000.0);
    field("min_bounded", self.min_bounded, 0.0, 1.0);
  }
};

}  // namespace mrpt_sgraphs
