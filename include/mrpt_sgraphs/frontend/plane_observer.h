// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/frontend/plane_segmentation.h"
#include "mrpt_sgraphs/frontend/scan_gatherer.h"

namespace mrpt_sgraphs {

/// What keyframes see of flat surfaces: the scans from one keyframe to the next are gathered, and
/// the planes are taken from all of them.
class PlaneObserver {
 public:
  explicit PlaneObserver(const PlaneSegmentationConfig& config);

  /// Every scan, in the order in which they were placed.
  /// @param deskewed    In the base frame; kept, not copied. One that is not deskewed is left out.
  /// @param registered  Whether the pose was measured. Where it was not, the poses before and after
  ///                    do not fit together: what was gathered is forgotten.
  void addScan(const Cloud::ConstPtr& deskewed, const Pose& T_odom_base, bool registered);

  /// The planes of the scans since the last call, in the base frame of the last one, which is the
  /// keyframe. Null if there was none, or if its pose was not measured.
  ObservedPlanesConstPtr take();

  void reset() { gatherer_.reset(); }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("gatherer", gatherer_);
  }

 private:
  PlaneSegmentationConfig config_;
  ScanGatherer gatherer_;
};

}  // namespace mrpt_sgraphs
