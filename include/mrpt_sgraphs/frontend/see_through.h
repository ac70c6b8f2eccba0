// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/geometry/cell_set.h"
#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// Where rays went through the plane of a surface, beside what was seen of it: a wall reaches the
/// ceiling and the next wall, a cabinet is seen over and past.
class SeeThrough {
 public:
  /// Rays are kept in cells of this edge.
  static constexpr double kCell_m = 0.2;

  SeeThrough() = default;

  /// @param frame_map  In the surface, its normal to the side that the surface is seen from.
  explicit SeeThrough(const PlaneFrame& frame_map) : frame_(frame_map) {}

  /// The rays of a scan that went through the plane and met something well behind it.
  /// @param cloud_base  With the sensor's place in `sensor_origin_`.
  /// @param around      Cells of interest, in this grid.
  void add(const Cloud& cloud_base, const Pose& T_map_base, const CellBox& around);

  /// The same of another surface that turned out to be this one.
  void add(const SeeThrough& other);

  /// Shares, from 0 to 1, of the surface's columns that were seen over, and of its rows that were
  /// seen past at either end.
  struct OpenEdges {
    double above = 0.0;
    double left = 0.0;
    double right = 0.0;
    double width_m = 0.0;
    bool stands_low = false;  ///< It reaches below where it was looked at from.
  };
  /// @param seen  Cells of this grid that the surface covers.
  OpenEdges openEdgesOf(const CellSet& seen) const;

  const PlaneFrame& frame() const { return frame_; }

  /// The surface was found to lie a little elsewhere.
  void moveTo(const Plane& plane_map) { frame_ = PlaneFrame(plane_map, frame_.origin); }

  template <typename Archive>
  void archive(Archive& a) {
    a("frame", frame_);
    a("passed", passed_);
    a("lowest_view_m", lowest_view_m_);
  }

 private:
  PlaneFrame frame_;
  CellSet passed_;
  double lowest_view_m_ = 1e9;  ///< Along v.
};

/// Whether edges are those of a piece of furniture, or of a pillar: seen over, or not wide and seen
/// past at both ends; at one end will do for what stands close before a wall.
bool isFurniture(const SeeThrough::OpenEdges& edges, bool has_wall_behind);

}  // namespace mrpt_sgraphs
