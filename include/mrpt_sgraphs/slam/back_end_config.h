// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/mapping/map_config.h"
#include "mrpt_sgraphs/semantics/floor_detector_config.h"
#include "mrpt_sgraphs/semantics/relocation.h"
#include "mrpt_sgraphs/semantics/room_detector_config.h"
#include "mrpt_sgraphs/slam/graph_slam_config.h"
#include "mrpt_sgraphs/slam/localization_config.h"

namespace mrpt_sgraphs {

/// The parameters of all that comes after the front end.
struct BackEndConfig : GraphSlamConfig {
  FloorDetectorConfig floors;
  RoomDetectorConfig room_detection;
  RelocationConfig relocation;
  LocalizationConfig localization;
  MapConfig map;

  /// The one list of its sections: `section(name, config)`.
  template <typename Self, typename Section>
  static void sections(Self& self, Section&& section) {
    section("loop_closure", self.loop_closure);
    section("walls", self.walls);
    section("ground", self.ground);
    section("floors", self.floors);
    section("room_detection", self.room_detection);
    section("rooms", self.rooms);
    section("hierarchy", self.hierarchy);
    section("solver", self.solver);
    section("relocation", self.relocation);
    section("localization", self.localization);
    section("map", self.map);
  }
};

}  // namespace mrpt_sgraphs
