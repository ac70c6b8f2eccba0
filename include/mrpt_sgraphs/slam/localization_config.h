// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace mrpt_sgraphs {

/// How a robot is followed in a map that does not change. What it is registered against is that of
/// RelocationConfig.
struct LocalizationConfig {
  double submap_move_m = 3.0;   ///< Way after which the map around the robot is taken anew.
  double min_inlier_ratio = 0.35;  ///< Share of a keyframe's points that have to lie on the map,
  double min_consistency = 0.75;   ///< and of those that could.
  double max_chi2 = 50.0;  ///< Gate on a keyframe being where it was expected, 6 degrees of freedom.
  double lost_after_m = 5.0;    ///< Way without a keyframe that fits.
  int max_session_keyframes = 100;  ///< While lost: of more, the newer half is kept.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("submap_move_m", self.submap_move_m, 0.1, 100.0);
    field("min_inlier_ratio", self.min_inlier_ratio, 0.05, 1.0);
    field("min_consistency", self.min_consistency, 0.05, 1.0);
    field("max_chi2", self.max_chi2, 1.0, 1e6);
    field("lost_after_m", self.lost_after_m, 0.1, 1000.0);
    field("max_session_keyframes", self.max_session_keyframes, 10, 10000);
  }
};

}  // namespace mrpt_sgraphs
