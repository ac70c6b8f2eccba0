// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/scan_gatherer.h"
#include "mrpt_sgraphs/geometry/observed_plane.h"

namespace mrpt_sgraphs {

/// What is a plane, and how well it is known.
struct PlaneSegmentationConfig {
  int gathered_points = 60000;     ///< Scans are gathered until there are so many.
  double max_thickness_m = 0.03;   ///< One sigma of the points across a plane.
  int min_points = 40;             ///< Fewer points are no plane.
  double min_area_m2 = 0.3;        ///< A smaller one is no plane.
  double max_gap_m = 1.5;          ///< Surfaces in one line that lie farther apart are two.
  double systematic_m = 0.01;      ///< No plane is known better at its centroid than this,
  double systematic_rad = 0.0035;  ///< and no normal better than this.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("gathered_points", self.gathered_points, 1, 10000000);
    field("max_thickness_m", self.max_thickness_m, 0.002, 0.5);
    field("min_points", self.min_points, 4, 100000);
    field("min_area_m2", self.min_area_m2, 0.01, 100.0);
    field("max_gap_m", self.max_gap_m, 0.1, 100.0);
    field("systematic_m", self.systematic_m, 0.0, 1.0);
    field("systematic_rad", self.systematic_rad, 0.0, 0.5);
  }
};

/// A plane among points, and which of them lie on it.
struct PlaneSegment : ObservedPlane {
  std::vector<int> indices;  ///< Into the cloud.
};

/// The flat surfaces among the points, the largest first. Each is turned to the side that it was
/// seen from, so the two faces of a wall are two planes.
std::vector<PlaneSegment> segmentPlanes(const GatheredPoints& points,
                                        const PlaneSegmentationConfig& config);

/// What a keyframe keeps of them.
ObservedPlanesConstPtr observedPlanes(const std::vector<PlaneSegment>& segments);

}  // namespace mrpt_sgraphs
