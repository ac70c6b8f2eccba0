// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <deque>
#include <vector>

#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Points seen from a few places, in one frame.
struct GatheredPoints {
  /// A run of points that one scan saw.
  struct View {
    std::size_t first = 0;  ///< Index of its first point; it ends where the next begins.
    Eigen::Vector3d viewpoint{0.0, 0.0, 0.0};  ///< Where the sensor was [m].
  };

  Cloud cloud;
  std::vector<View> views;
};

/// The points of one scan and where they were seen from: `sensor_origin_`.
GatheredPoints gatheredFrom(const Cloud& scan);

/// Gathers the scans from one keyframe to the next, since one scan of few beams shows little of a
/// wall. Takes no more than are needed: of a dense sensor, only the keyframe's own scan.
class ScanGatherer {
 public:
  /// @param wanted_points  Older scans are added until there are so many.
  explicit ScanGatherer(std::size_t wanted_points) : wanted_points_(wanted_points) {}

  /// @param deskewed  In the base frame; kept, not copied.
  void add(const Cloud::ConstPtr& deskewed, const Pose& T_odom_base);

  /// All that was added since the last call, the newest scan's base as its frame, and forgets it.
  /// @throws std::logic_error if nothing was added.
  GatheredPoints take();

  bool empty() const { return scans_.empty(); }
  void reset() { scans_.clear(); }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("scans", scans_);
  }

 private:
  struct Scan {
    Cloud::ConstPtr cloud;
    Pose T_odom_base;

    template <typename Archive>
    void archive(Archive& a) {
      a("cloud", cloud);
      a("T_odom_base", T_odom_base);
    }
  };

  std::size_t wanted_points_;
  std::deque<Scan> scans_;
};

}  // namespace mrpt_sgraphs
