// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mrpt_sgraphs {

/// Names of the frames (REP-105).
struct FramesConfig {
  std::string map = "map";
  std::string odom = "odom";
  std::string base;  ///< Empty: the cloud's own frame.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("map", self.map);
    field("odom", self.odom);
    field("base", self.base);
  }
};

/// Which of the optional inputs are used.
struct InputsConfig {
  bool imu = false;
  bool odom_in = false;

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("imu", self.imu);
    field("odom_in", self.odom_in);
  }
};

/// How the graph is shown.
struct DisplayConfig {
  double layer_lift_m = 10.0;  ///< Each layer so far above the one below; 0: all of it in place.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("layer_lift_m", self.layer_lift_m, 0.0, 1000.0);
  }
};

/// tf2 knows no leading slash; old drivers and bags still write it.
inline std::string frameName(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

}  // namespace mrpt_sgraphs
