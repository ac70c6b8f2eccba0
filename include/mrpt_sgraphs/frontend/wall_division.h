// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "mrpt_sgraphs/frontend/wall_track.h"

namespace mrpt_sgraphs {

/// Where another wall stands on a surface: between the rooms to its left and to its right, whose
/// walls often lie in one line.
class WallDivision {
 public:
  /// @param frame_map  In the surface.
  /// @return Nothing where `crossing` does not stand on the surface, from its foot on by more than
  ///         furniture does.
  static std::optional<WallDivision> of(const PlaneFrame& frame_map, const WallTrack& crossing);

  /// On which side along u an extent lies all but for the thickness of a wall: -1, 1, or 0 for both.
  int sideOf(const WallExtent& extent) const;

 private:
  PlaneFrame frame_;
  double at_m_ = 0.0;  ///< Along u.
};

}  // namespace mrpt_sgraphs
