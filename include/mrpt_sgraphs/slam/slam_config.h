// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/odometry.h"
#include "mrpt_sgraphs/frontend/plane_segmentation.h"
#include "mrpt_sgraphs/frontend/prefilter.h"
#include "mrpt_sgraphs/slam/back_end_config.h"

namespace mrpt_sgraphs {

/// Every parameter of the pipeline, in sections that have the same names in YAML files, on the
/// parameter server and here.
struct SlamConfig : BackEndConfig {
  PrefilterConfig prefilter;
  OdometryConfig odometry;
  KeyframeConfig keyframes;
  PlaneSegmentationConfig plane_segmentation;

  /// The one list of sections: `section(name, config)`.
  template <typename Self, typename Section>
  static void sections(Self& self, Section&& section) {
    section("prefilter", self.prefilter);
    section("odometry", self.odometry);
    section("keyframes", self.keyframes);
    section("plane_segmentation", self.plane_segmentation);
    BackEndConfig::sections(self, section);
  }
};

}  // namespace mrpt_sgraphs
