// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <string>

namespace mrpt_sgraphs {

/// What is optimized when, and what becomes of keyframes that are no longer needed one by one.
struct HierarchyConfig {
  /// baseline: nothing is compressed, the whole graph after every change. paper: the hierarchy of
  /// the paper, with its compression to the letter. condensed: the same without losing information.
  std::string mode = "condensed";
  int local_keyframes = 10;     ///< Of the window that every keyframe optimizes.
  int min_condensed = 5;        ///< Keyframes of a region that are dropped at a time.
  double region_radius_m = 5.0; ///< Around a kept keyframe, where no room is.
  int max_passages = 1;         ///< Keyframes that are kept for each way between two regions.
  /// Clouds and planes of dropped keyframes are let go of where another cloud was taken so near in the
  /// same room, so that memory grows with the area and not with the time spent there; 0: all are kept.
  double cloud_spacing_m = 1.0;
  /// Wall time after which an optimization begins no further iteration, and after which no further
  /// region is condensed for one keyframe; 0: none. sgraphs_offline knows none.
  double budget_ms = 100.0;

  static constexpr std::array<const char*, 3> kModes{"baseline", "paper", "condensed"};

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("mode", self.mode, kModes);
    field("local_keyframes", self.local_keyframes, 2, 1000);
    field("min_condensed", self.min_condensed, 1, 1000);
    field("region_radius_m", self.region_radius_m, 0.5, 100.0);
    field("max_passages", self.max_passages, 1, 100);
    field("cloud_spacing_m", self.cloud_spacing_m, 0.0, 100.0);
    field("budget_ms", self.budget_ms, 0.0, 1e6);
  }
};

}  // namespace mrpt_sgraphs
